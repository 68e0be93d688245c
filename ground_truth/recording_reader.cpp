#include "reckon/ground_truth/recording_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reckon/ground_truth/hdf5_handle.h"
#include "reckon/ground_truth/record_codec.h"
#include "reckon/ground_truth/recording_columns.h"
#include "reckon/ground_truth/run_recorder.h"
#include "reckon/ground_truth/table_reader.h"

namespace reckon::ground_truth {
namespace {

constexpr std::size_t kCovarianceWidth = estimator::kErrorSize * (estimator::kErrorSize + 1) / 2;

template <class Row>
Cursor<Row> Nothing() {
  return Cursor<Row>([]() -> std::optional<Row> { return std::nullopt; });
}

/// What `decode` makes of `row`, which `table` gave last; says where it is if it is damaged.
template <class Decode>
auto Decoded(const TableReader& table, const std::byte* row, const Decode& decode) {
  RowDecoder decoder(row);
  try {
    return decode(decoder);
  } catch (const RecordingError& error) {
    throw RecordingError(fmt::format("{}: {}", table.Place(), error.what()));
  }
}

/// A cursor over `table`; `decode` turns a RowDecoder into a row.
template <class Row, class Decode>
Cursor<Row> Over(std::shared_ptr<const void> keep, std::shared_ptr<TableReader> table,
                 Decode decode) {
  return Cursor<Row>(
      [keep = std::move(keep), table = std::move(table), decode]() mutable -> std::optional<Row> {
        const std::byte* row = table->Next();
        if (row == nullptr) return std::nullopt;
        return Decoded(*table, row, decode);
      });
}

/// Merges the sensors' tables by the measurements' order.
class MeasurementMerge {
 public:
  void AddSensor(models::SensorId id, const RecordedSensor& sensor,
                 std::shared_ptr<TableReader> table) {
    streams_.push_back(
        {id, sensor.sensor.kind, static_cast<int>(sensor.channels.size()), std::move(table)});
    Refill(streams_.size() - 1);
  }

  std::optional<models::Measurement> Next() {
    const auto first = heads_.begin();
    if (first == heads_.end() || first->first != next_order_) return std::nullopt;
    const auto [stream, measurement] = first->second;
    heads_.erase(first);
    ++next_order_;
    Refill(stream);
    return measurement;
  }

 private:
  struct Stream {
    models::SensorId id;
    models::SensorKind kind;
    int channels;
    std::shared_ptr<TableReader> table;
  };

  void Refill(std::size_t index) {
    const Stream& stream = streams_[index];
    const std::byte* row = stream.table->Next();
    if (row == nullptr) return;
    std::uint64_t order = 0;
    const models::Measurement measurement = Decoded(*stream.table, row, [&](RowDecoder& decoder) {
      return DecodeMeasurement(decoder, stream.id, stream.kind, stream.channels, &order);
    });
    heads_.emplace(order, std::make_pair(index, measurement));
  }

  std::vector<Stream> streams_;
  std::map<std::uint64_t, std::pair<std::size_t, models::Measurement>> heads_;
  std::uint64_t next_order_ = 0;
};

}  // namespace

class RecordingReader::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path) {
    Open();
    if (Attribute("format") != std::string(Conventions()[0].second)) {
      throw RecordingError(fmt::format("{}: not a recording of this version", path_.string()));
    }
    estimators_ = ReadTexts(file_.get(), "estimators");
    wheels_ = ReadTexts(file_.get(), "wheels");
    feet_ = ReadTexts(file_.get(), "feet");
    if (feet_.size() > models::kMaxFeet)
      throw RecordingError("damaged: more feet than there can be");
    for (const auto& name : ReadTexts(file_.get(), "sensors")) {
      mounted_.emplace_back().name = name;
      if (Has("measurements/" + name)) DescribeSensor(name);
    }
  }

  bool closed() const { return closed_; }
  const std::vector<models::MountedSensor>& mounted() const { return mounted_; }
  const std::vector<std::string>& estimators() const { return estimators_; }
  const std::vector<std::string>& wheels() const { return wheels_; }
  const std::vector<std::string>& feet() const { return feet_; }
  const std::vector<RecordedSensor>& recorded() const { return recorded_; }

  std::optional<std::string> Attribute(const std::string& name) const {
    const auto texts = ReadTexts(file_.get(), name);
    if (texts.empty()) return std::nullopt;
    return texts.front();
  }

  bool Has(const std::string& name) const {
    const Hdf5Quiet quiet;
    std::string part;  // H5Lexists wants every group on the way to exist
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
      part = name.substr(0, end);
      if (H5Lexists(file_.get(), part.c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }

  std::shared_ptr<TableReader> Table(const std::string& name, const Columns& columns,
                                     std::size_t width = 0) const {
    return std::make_shared<TableReader>(file_.get(), path_, name, columns, width);
  }

  std::string Group(std::size_t estimator) const {
    return "estimates/" + estimators_.at(estimator);
  }

 private:
  void Open() {
    const Hdf5Quiet quiet;
    if (!std::filesystem::is_regular_file(path_)) {
      throw RecordingError(fmt::format("{}: no such file", path_.string()));
    }
    const hid_t closed = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    closed_ = closed >= 0;
    file_ = closed_ ? Hdf5Handle(closed, H5Fclose)
                    : Own(H5Fopen(path_.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, H5P_DEFAULT),
                          H5Fclose, path_, "can't read the recording");
  }

  void DescribeSensor(const std::string& name) {
    models::MountedSensor& sensor = mounted_.back();
    const Hdf5Handle dataset(H5Dopen2(file_.get(), ("measurements/" + name).c_str(), H5P_DEFAULT),
                             H5Dclose);
    const auto kind = ReadTexts(dataset.get(), "kind");
    const auto names = SensorKindNames();
    const auto found = std::find(names.begin(), names.end(), kind.empty() ? "" : kind.front());
    if (found == names.end()) {
      throw RecordingError(fmt::format("{}: sensor {} has no known kind", path_.string(), name));
    }
    sensor.kind = static_cast<models::SensorKind>(found - names.begin());
    sensor.period_ns = std::llround(1e9 * ReadNumbers(dataset.get(), "period_s", 1)[0]);
    const auto R = ReadNumbers(dataset.get(), "R_BS", 9),
               p = ReadNumbers(dataset.get(), "p_BS_m", 3);
    for (int i = 0; i < 9; ++i) sensor.X_BS.R(i / 3, i % 3) = R[static_cast<std::size_t>(i)];
    for (int i = 0; i < 3; ++i) sensor.X_BS.p[i] = p[static_cast<std::size_t>(i)];
    recorded_.push_back({sensor, ReadTexts(dataset.get(), "channels")});
    CheckChannels(recorded_.back());
  }

  /// A sample can't hold more channels than its type has room for.
  void CheckChannels(const RecordedSensor& recorded) const {
    const auto most = static_cast<std::size_t>(models::MostChannels(recorded.sensor.kind));
    if (recorded.channels.size() <= most) return;
    throw RecordingError(fmt::format("{}: sensor {} has {} channels, at most {} are possible",
                                     path_.string(), recorded.sensor.name, recorded.channels.size(),
                                     most));
  }

  std::vector<std::string> ReadTexts(hid_t object, const std::string& name) const {
    const Hdf5Quiet quiet;
    if (H5Aexists(object, name.c_str()) <= 0) return {};
    const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (H5Tis_variable_str(type.get()) <= 0) ThrowHdf5(path_, "attribute is no text: " + name);
    std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    if (H5Aread(attribute.get(), type.get(), raw.data()) < 0)
      ThrowHdf5(path_, "can't read " + name);
    std::vector<std::string> texts(raw.begin(), raw.end());
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, raw.data());
    return texts;
  }

  std::vector<double> ReadNumbers(hid_t object, const std::string& name, std::size_t size) const {
    const Hdf5Quiet quiet;
    std::vector<double> numbers(size);
    const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(size) ||
        H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, numbers.data()) < 0) {
      ThrowHdf5(path_, "can't read attribute " + name);
    }
    return numbers;
  }

  std::filesystem::path path_;
  Hdf5Handle file_;
  bool closed_ = false;
  std::vector<std::string> estimators_, wheels_, feet_;
  std::vector<models::MountedSensor> mounted_;
  std::vector<RecordedSensor> recorded_;  ///< in order of id; empty if no measurements were kept
};

RecordingReader::RecordingReader(const std::filesystem::path& path)
    : impl_(std::make_shared<Impl>(path)) {}
RecordingReader::~RecordingReader() = default;
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;

bool RecordingReader::closed() const { return impl_->closed(); }
std::optional<std::string> RecordingReader::Attribute(const std::string& name) const {
  return impl_->Attribute(name);
}
const std::vector<models::MountedSensor>& RecordingReader::sensors() const {
  return impl_->mounted();
}
const std::vector<std::string>& RecordingReader::estimators() const { return impl_->estimators(); }

Cursor<Truth> RecordingReader::ReadTruth() const {
  if (!impl_->Has("truth")) return Nothing<Truth>();
  const int wheels = static_cast<int>(impl_->wheels().size());
  const int feet = static_cast<int>(impl_->feet().size());
  return Over<Truth>(impl_, impl_->Table("truth", TruthColumns(impl_->wheels(), impl_->feet())),
                     [wheels, feet](RowDecoder& row) { return DecodeTruth(row, wheels, feet); });
}

Cursor<models::Measurement> RecordingReader::ReadMeasurements() const {
  auto merge = std::make_shared<MeasurementMerge>();
  for (std::size_t id = 0; id < impl_->recorded().size(); ++id) {
    const RecordedSensor& sensor = impl_->recorded()[id];
    merge->AddSensor(
        static_cast<models::SensorId>(id), sensor,
        impl_->Table("measurements/" + sensor.sensor.name, MeasurementColumns(sensor)));
  }
  return Cursor<models::Measurement>([keep = impl_, merge] { return merge->Next(); });
}

Cursor<estimator::Estimate> RecordingReader::ReadEstimates(std::size_t estimator) const {
  const std::string group = impl_->Group(estimator);
  if (!impl_->Has(group + "/state")) return Nothing<estimator::Estimate>();
  std::shared_ptr<TableReader> covariances;
  if (impl_->Has(group + "/covariance")) {
    covariances = impl_->Table(group + "/covariance", {}, kCovarianceWidth);
  }
  const int feet = static_cast<int>(impl_->feet().size());
  const auto states = impl_->Table(group + "/state", EstimateColumns(impl_->feet()));
  return Cursor<estimator::Estimate>(
      [keep = impl_, states, covariances, feet]() -> std::optional<estimator::Estimate> {
        const std::byte* row = states->Next();
        if (row == nullptr) return std::nullopt;
        std::int64_t covariance_row = -1;
        estimator::Estimate estimate = Decoded(*states, row, [&](RowDecoder& decoder) {
          return DecodeEstimate(decoder, feet, &covariance_row);
        });
        estimate.has_covariance = covariance_row >= 0;
        if (!estimate.has_covariance) return estimate;
        const std::byte* const triangle = covariances ? covariances->Next() : nullptr;
        if (triangle == nullptr) return std::nullopt;  // cut off: its covariance was lost
        RowDecoder(triangle).GetSymmetric(estimate.covariance);
        return estimate;
      });
}

Cursor<estimator::Correction> RecordingReader::ReadCorrections(std::size_t estimator) const {
  const std::string name = impl_->Group(estimator) + "/corrections";
  if (!impl_->Has(name)) return Nothing<estimator::Correction>();
  return Over<estimator::Correction>(impl_, impl_->Table(name, CorrectionColumns()),
                                     [sensors = impl_->mounted().size()](RowDecoder& row) {
                                       return DecodeCorrection(row, sensors);
                                     });
}

Cursor<RefusedMeasurement> RecordingReader::ReadRefusals(std::size_t estimator) const {
  const std::string name = impl_->Group(estimator) + "/refusals";
  if (!impl_->Has(name)) return Nothing<RefusedMeasurement>();
  return Over<RefusedMeasurement>(
      impl_, impl_->Table(name, RefusalColumns()),
      [sensors = impl_->mounted().size()](RowDecoder& row) { return DecodeRefusal(row, sensors); });
}

std::optional<estimator::Prior> RecordingReader::ReadPrior(std::size_t estimator) const {
  const std::string group = impl_->Group(estimator);
  const auto priors = impl_->Table(group + "/prior", PriorColumns());
  const auto covariances = impl_->Table(group + "/prior_covariance", {}, kCovarianceWidth);
  const std::byte* const row = priors->Next();
  const std::byte* const triangle = covariances->Next();
  if (row == nullptr || triangle == nullptr) return std::nullopt;
  RowDecoder decoder(row);
  estimator::Prior prior = DecodePrior(decoder);
  RowDecoder(triangle).GetSymmetric(prior.covariance);
  return prior;
}

}  // namespace reckon::ground_truth
