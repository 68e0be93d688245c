#include "reckon/ground_truth/run_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "reckon/ground_truth/hdf5_handle.h"
#include "reckon/ground_truth/newest_orders.h"
#include "reckon/ground_truth/record_codec.h"
#include "reckon/ground_truth/recording_columns.h"
#include "reckon/ground_truth/table_writer.h"

namespace reckon::ground_truth {
namespace {

constexpr std::size_t kCovarianceWidth = estimator::kErrorSize * (estimator::kErrorSize + 1) / 2;

std::vector<std::string> Strings(std::span<const std::string_view> views) {
  return {views.begin(), views.end()};
}

Hdf5Handle CreateFile(const std::filesystem::path& path) {
  bool threadsafe = false;
  if (H5is_library_threadsafe(&threadsafe) < 0 || !threadsafe) {
    throw RecordingError("this HDF5 library was built without thread safety");
  }
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return Own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, path,
             "can't make the recording");
}

std::size_t ChunkRows(std::size_t row_bytes) {
  return std::clamp<std::size_t>(RunRecorder::kChunkBytes / row_bytes, 1, RunRecorder::kChunkRows);
}

/// Thins rows: the first at or after each multiple of a period is due. Rows whose stamps never hit
/// a multiple (another rate, a clock with jitter) are thinned like those that do.
class Thinning {
 public:
  /// A period of 0 keeps every row.
  explicit Thinning(models::TimeNs period_ns = 0) : period_ns_(period_ns) {}

  bool IsDue(models::TimeNs t_ns) {
    if (period_ns_ <= 0) return true;
    if (t_ns < next_ns_) return false;
    const models::TimeNs since_ns = ((t_ns % period_ns_) + period_ns_) % period_ns_;
    next_ns_ = t_ns - since_ns + period_ns_;
    return true;
  }

 private:
  models::TimeNs period_ns_;
  models::TimeNs next_ns_ = std::numeric_limits<models::TimeNs>::min();
};

/// The tables of one estimator.
struct EstimatorTables {
  Thinning thinning;
  std::optional<TableWriter> state, covariance, corrections, refusals, prior, prior_covariance;
  std::int64_t covariance_rows = 0;
};

}  // namespace

class RunRecorder::Impl {
 public:
  Impl(const std::filesystem::path& path, RecordingPlan plan)
      : path_(path),
        plan_(std::move(plan)),
        file_(CreateFile(path)),
        truth_thinning_(plan_.truth_period_ns),
        orders_(plan_.sensors.size()) {
    DescribeFile();
    if (plan_.truth) MakeTruth();
    if (plan_.measurements) MakeMeasurements();
    MakeGroup("estimates");
    estimators_.resize(plan_.estimators.size());
    for (std::size_t i = 0; i < estimators_.size(); ++i) MakeEstimator(i);
    if (H5Fstart_swmr_write(file_.get()) < 0) ThrowHdf5(path_, "can't start writing");
  }

  ~Impl() {
    try {
      Close();
    } catch (const RecordingError&) {  // the caller did not want to hear of it
    }
  }

  void Add(const Truth& truth) {
    if (!truth_ || !truth_thinning_.IsDue(truth.t_ns)) return;
    const auto wheels = static_cast<Eigen::Index>(plan_.wheels.size());
    if (truth.wheel_rate_rad_s.size() != wheels || truth.wheel_slip_m_s.size() != wheels ||
        truth.wheel_load_n.size() != wheels) {
      throw std::invalid_argument("truth with another number of wheels than planned");
    }
    if (truth.feet.count != static_cast<int>(plan_.feet.size())) {
      throw std::invalid_argument("truth with another number of feet than planned");
    }
    truth_->Append([&truth](RowEncoder& row) { Encode(truth, row); });
  }

  void Add(const models::Measurement& measurement) {
    CheckShape(measurement);
    const std::uint64_t order = next_order_++;
    orders_.Add(measurement.sensor, measurement.valid_ns, order);
    if (!plan_.measurements) return;
    measurements_[measurement.sensor].Append(
        [&](RowEncoder& row) { Encode(measurement, order, row); });
  }

  void Add(std::size_t index, const estimator::Estimate& estimate) {
    EstimatorTables& tables = estimators_.at(index);
    if (!tables.state || !tables.thinning.IsDue(estimate.t_ns)) return;
    const bool covariance = tables.covariance && estimate.has_covariance;
    const std::int64_t covariance_row = covariance ? tables.covariance_rows++ : -1;
    if (covariance) {
      tables.covariance->Append(
          [&estimate](RowEncoder& row) { row.PutSymmetric(estimate.covariance); });
    }
    const auto feet = static_cast<int>(plan_.feet.size());
    tables.state->Append([&](RowEncoder& row) { Encode(estimate, covariance_row, feet, row); });
  }

  void Add(std::size_t index, const models::Measurement& measurement,
           const estimator::Report& report) {
    EstimatorTables& tables = estimators_.at(index);
    if (!tables.corrections) return;
    for (const estimator::Correction& correction : report.corrections()) {
      const std::uint64_t order = orders_.Find(correction.sensor, correction.t_ns);
      tables.corrections->Append([&](RowEncoder& row) { Encode(correction, order, row); });
    }
    if (report.refusal != estimator::Refusal::kNone &&
        report.refusal != estimator::Refusal::kUnused) {
      const std::uint64_t order = next_order_ - 1;  // of the measurement added last
      tables.refusals->Append(
          [&](RowEncoder& row) { Encode(measurement, report.refusal, order, row); });
    }
  }

  void AddPrior(std::size_t index, const estimator::Prior& prior) {
    EstimatorTables& tables = estimators_.at(index);
    tables.prior->Append([&prior](RowEncoder& row) { Encode(prior, row); });
    tables.prior_covariance->Append(
        [&prior](RowEncoder& row) { row.PutSymmetric(prior.covariance); });
  }

  void Close() {
    if (closed_) return;
    closed_ = true;
    const Hdf5Quiet quiet;
    try {
      bool failed = false;
      ForEachTable([&failed](TableWriter& table) { failed = failed || table.failed(); });
      if (failed) throw RecordingError(path_.string() + ": an earlier write failed");
      ForEachTable([](TableWriter& table) { table.Flush(); });
      if (H5Fflush(file_.get(), H5F_SCOPE_LOCAL) < 0) ThrowHdf5(path_, "can't write");
    } catch (const RecordingError&) {
      DivertFile(file_.get());
      CloseAll();
      throw;
    }
    if (!CloseAll()) ThrowHdf5(path_, "can't close");
  }

 private:
  bool CloseAll() {
    bool closed = true;
    ForEachTable([&closed](TableWriter& table) { closed = table.Close() && closed; });
    return file_.Close() && closed;
  }

  void CheckShape(const models::Measurement& measurement) const {
    const RecordedSensor& planned = plan_.sensors.at(measurement.sensor);
    if (measurement.sample.index() != static_cast<std::size_t>(planned.sensor.kind)) {
      throw std::invalid_argument("sensor '" + planned.sensor.name +
                                  "' sent another kind of sample");
    }
    const auto* encoders = std::get_if<models::EncoderSample>(&measurement.sample);
    const auto channels = static_cast<int>(planned.channels.size());
    if (models::Channels(measurement.sample) != channels ||
        (encoders != nullptr && encoders->rate_rad_s.size() != channels)) {
      throw std::invalid_argument("sensor '" + planned.sensor.name +
                                  "' sent another number of channels than planned");
    }
  }

  void DescribeFile() {
    for (const auto& [name, text] : Conventions()) {
      WriteAttribute(file_.get(), std::string(name), std::string(text));
    }
    for (const auto& [name, text] : plan_.attributes) WriteAttribute(file_.get(), name, text);
    WriteAttribute(file_.get(), "estimators", plan_.estimators);
    WriteAttribute(file_.get(), "wheels", plan_.wheels);
    WriteAttribute(file_.get(), "feet", plan_.feet);
    WriteAttribute(file_.get(), "sensors", SensorNames());
  }

  std::vector<std::string> SensorNames() const {
    std::vector<std::string> names;
    for (const RecordedSensor& sensor : plan_.sensors) names.push_back(sensor.sensor.name);
    return names;
  }

  void MakeGroup(const std::string& name) {
    const Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    Own(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Gclose,
        path_, "can't make group " + name);
  }

  TableWriter MakeTable(const std::string& name, const Columns& columns) {
    return {file_.get(), path_, name, columns, ChunkRows(RowBytes(columns))};
  }

  TableWriter MakeCovariance(const std::string& name, std::size_t chunk_rows) {
    TableWriter table(file_.get(), path_, name, {}, chunk_rows, kCovarianceWidth);
    std::vector<double> rows, columns;
    for (int i = 0; i < estimator::kErrorSize; ++i) {
      for (int j = i; j < estimator::kErrorSize; ++j) {
        rows.push_back(i);
        columns.push_back(j);
      }
    }
    WriteAttribute(table.dataset(), "row", rows);
    WriteAttribute(table.dataset(), "column", columns);
    WriteAttribute(table.dataset(), "error_names", ErrorNames());
    WriteAttribute(table.dataset(), "units", std::string("products of rad, m/s, m, rad/s, m/s^2"));
    return table;
  }

  void MakeTruth() { truth_.emplace(MakeTable("truth", TruthColumns(plan_.wheels, plan_.feet))); }

  void MakeMeasurements() {
    MakeGroup("measurements");
    for (std::size_t id = 0; id < plan_.sensors.size(); ++id) {
      const RecordedSensor& recorded = plan_.sensors[id];
      measurements_.push_back(
          MakeTable("measurements/" + recorded.sensor.name, MeasurementColumns(recorded)));
      const hid_t dataset = measurements_.back().dataset();
      const auto kind = static_cast<std::size_t>(recorded.sensor.kind);
      WriteAttribute(dataset, "kind", std::string(SensorKindNames()[kind]));
      WriteAttribute(dataset, "channels", recorded.channels);
      const auto& X_BS = recorded.sensor.X_BS;
      const Eigen::Matrix3d R_SB = X_BS.R.transpose();  // column-major: R_BS row by row
      WriteAttribute(dataset, "R_BS", std::vector<double>(R_SB.data(), R_SB.data() + 9));
      WriteAttribute(dataset, "p_BS_m", std::vector<double>(X_BS.p.data(), X_BS.p.data() + 3));
      WriteAttribute(dataset, "period_s",
                     std::vector<double>{models::Seconds(recorded.sensor.period_ns)});
    }
  }

  void MakeEstimator(std::size_t index) {
    EstimatorTables& tables = estimators_[index];
    const std::string group = "estimates/" + plan_.estimators[index];
    MakeGroup(group);
    tables.thinning = Thinning(plan_.estimate_period_ns);
    if (plan_.estimates) {
      tables.state.emplace(MakeTable(group + "/state", EstimateColumns(plan_.feet)));
      WriteAttribute(tables.state->dataset(), "error_form_names", Strings(ErrorFormNames()));
      if (plan_.covariance) {
        const std::size_t row_bytes = kCovarianceWidth * sizeof(double);
        tables.covariance.emplace(MakeCovariance(group + "/covariance", ChunkRows(row_bytes)));
      }
    }
    if (plan_.corrections) {
      tables.corrections.emplace(MakeTable(group + "/corrections", CorrectionColumns()));
      tables.refusals.emplace(MakeTable(group + "/refusals", RefusalColumns()));
      for (TableWriter* table : {&*tables.corrections, &*tables.refusals}) {
        WriteAttribute(table->dataset(), "decision_names", Strings(DecisionNames()));
        WriteAttribute(table->dataset(), "refusal_names", Strings(RefusalNames()));
        WriteAttribute(table->dataset(), "sensor_names", SensorNames());
      }
    }
    tables.prior.emplace(file_.get(), path_, group + "/prior", PriorColumns(), 1);
    tables.prior_covariance.emplace(MakeCovariance(group + "/prior_covariance", 1));
  }

  template <class Function>
  void ForEachTable(Function&& function) {
    if (truth_) function(*truth_);
    for (TableWriter& table : measurements_) function(table);
    for (EstimatorTables& tables : estimators_) {
      for (auto* table : {&tables.state, &tables.covariance, &tables.corrections, &tables.refusals,
                          &tables.prior, &tables.prior_covariance}) {
        if (*table) function(**table);
      }
    }
  }

  std::filesystem::path path_;
  RecordingPlan plan_;
  Hdf5Handle file_;
  std::optional<TableWriter> truth_;
  Thinning truth_thinning_;
  std::vector<TableWriter> measurements_;
  std::vector<EstimatorTables> estimators_;
  std::uint64_t next_order_ = 0;
  NewestOrders orders_;
  bool closed_ = false;
};

RunRecorder::RunRecorder(const std::filesystem::path& path, RecordingPlan plan) {
  const Hdf5Quiet quiet;
  impl_ = std::make_unique<Impl>(path, std::move(plan));
}
RunRecorder::~RunRecorder() = default;
RunRecorder::RunRecorder(RunRecorder&&) noexcept = default;
RunRecorder& RunRecorder::operator=(RunRecorder&&) noexcept = default;

void RunRecorder::Add(const Truth& truth) { impl_->Add(truth); }
void RunRecorder::Add(const models::Measurement& measurement) { impl_->Add(measurement); }
void RunRecorder::Add(std::size_t estimator, const estimator::Estimate& estimate) {
  impl_->Add(estimator, estimate);
}
void RunRecorder::Add(std::size_t estimator, const models::Measurement& measurement,
                      const estimator::Report& report) {
  impl_->Add(estimator, measurement, report);
}
void RunRecorder::AddPrior(std::size_t estimator, const estimator::Prior& prior) {
  impl_->AddPrior(estimator, prior);
}
void RunRecorder::Close() { impl_->Close(); }

}  // namespace reckon::ground_truth
