#include "reckon/harness/csv_stream.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace reckon::harness {
namespace {

using models::SensorKind;
using models::TimeNs;

constexpr std::array kAxes{"x", "y", "z"};

Eigen::Matrix3d Rotation(const CsvTable& table, const std::array<std::size_t, 4>& wxyz) {
  const Eigen::Quaterniond q(table.Number(wxyz[0]), table.Number(wxyz[1]), table.Number(wxyz[2]),
                             table.Number(wxyz[3]));
  return q.normalized().toRotationMatrix();
}

/// All of `names`, or none of them.
std::vector<std::size_t> FindAll(const CsvTable& table, const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    if (const auto place = table.Find(name)) places.push_back(*place);
  }
  if (!places.empty() && places.size() < names.size()) {
    for (const std::string& name : names) (void)table.Need(name);
  }
  return places;
}

std::vector<std::string> Named(const std::vector<std::string>& names, const std::string& suffix) {
  std::vector<std::string> full;
  full.reserve(names.size());
  for (const std::string& name : names) full.push_back(name + suffix);
  return full;
}

}  // namespace

std::optional<TimeColumn> FindTime(const CsvTable& table, const std::string& name) {
  if (const auto ns = table.Find(name + "_ns")) return TimeColumn{*ns, false};
  if (const auto s = table.Find(name + "_s")) return TimeColumn{*s, true};
  return std::nullopt;
}

TimeColumn NeedTime(const CsvTable& table, const std::string& name) {
  if (const auto found = FindTime(table, name)) return *found;
  return {table.Need(name + "_s"), true};
}

std::optional<Columns3> Find3(const CsvTable& table, const std::string& prefix,
                              const std::string& suffix) {
  std::vector<std::string> names;
  names.reserve(kAxes.size());
  for (const char* axis : kAxes) names.push_back(prefix + axis + suffix);
  const auto places = FindAll(table, names);
  if (places.empty()) return std::nullopt;
  return Columns3{places[0], places[1], places[2]};
}

Columns3 Need3(const CsvTable& table, const std::string& prefix, const std::string& suffix) {
  if (const auto found = Find3(table, prefix, suffix)) return *found;
  (void)table.Need(prefix + "x" + suffix);
  return {};
}

Eigen::Vector3d Vector(const CsvTable& table, const Columns3& columns) {
  return {table.Number(columns[0]), table.Number(columns[1]), table.Number(columns[2])};
}

CsvStream::CsvStream(const std::filesystem::path& path, const LogSensor& sensor,
                     models::SensorId id)
    : table_(path),
      sensor_(sensor),
      id_(id),
      time_(NeedTime(table_, "t")),
      arrival_(FindTime(table_, "arrival")),
      interval_(table_.Find("interval_s")) {
  FindColumns();
  Advance();
}

void CsvStream::FindColumns() {
  const auto need = [this](const std::vector<std::string>& names) {
    for (const std::string& name : names) columns_.push_back(table_.Need(name));
  };
  switch (sensor_.kind) {
    case SensorKind::kImu:
      return need({"gyro_x_rad_s", "gyro_y_rad_s", "gyro_z_rad_s", "accel_x_m_s2", "accel_y_m_s2",
                   "accel_z_m_s2"});
    case SensorKind::kEncoders:
      columns_ = FindAll(table_, Named(sensor_.channels, "_rad"));
      more_columns_ = FindAll(table_, Named(sensor_.channels, "_rad_s"));
      if (more_columns_.empty() && columns_.empty()) need(Named(sensor_.channels, "_rad"));
      return;
    case SensorKind::kBodyVelocity:
      need({"v_x_m_s", "v_y_m_s", "v_z_m_s"});
      more_columns_ = FindAll(table_, {"cov_xx_m2_s2", "cov_xy_m2_s2", "cov_xz_m2_s2",
                                       "cov_yy_m2_s2", "cov_yz_m2_s2", "cov_zz_m2_s2"});
      valid_ = table_.Find("valid");
      over_ground_ = table_.Find("over_ground");
      return;
    case SensorKind::kDepth:
      return need({"depth_m"});
    case SensorKind::kPose:
      need({"p_x_m", "p_y_m", "p_z_m"});
      more_columns_ = FindAll(table_, {"q_w", "q_x", "q_y", "q_z"});
      return;
    case SensorKind::kContacts:
      return need(sensor_.channels);
    case SensorKind::kTorques:
      return need(Named(sensor_.channels, "_n_m"));
    case SensorKind::kFootForces:
      return need(Named(sensor_.channels, "_n"));
  }
}

void CsvStream::Advance() {
  last_ns_ = now_ ? now_ns_ : -1;
  now_.reset();
  if (!table_.Next()) return;
  now_ns_ = time_.Of(table_);
  models::Measurement measurement;
  measurement.sensor = id_;
  measurement.valid_ns = now_ns_;
  measurement.arrival_ns =
      arrival_ ? arrival_->Of(table_) : now_ns_ + std::llround(1e9 * sensor_.latency_s);
  measurement.sample = ReadSample();
  now_ = measurement;
}

/// Of a sample that covers the time since the last one, where the file does not say.
TimeNs CsvStream::Interval() const {
  if (interval_) return std::llround(1e9 * table_.Number(*interval_));
  const TimeNs nominal_ns = std::llround(1e9 / sensor_.rate_hz);
  const TimeNs since_ns = now_ns_ - last_ns_;
  // After a gap a sample covers no more than it does without one.
  return last_ns_ >= 0 && since_ns > 0 && since_ns < 2 * nominal_ns ? since_ns : nominal_ns;
}

models::Sample CsvStream::ReadSample() {
  switch (sensor_.kind) {
    case SensorKind::kImu:
      return ReadImu();
    case SensorKind::kEncoders:
      return ReadEncoders();
    case SensorKind::kBodyVelocity:
      return ReadVelocity();
    case SensorKind::kDepth:
      return models::DepthSample{table_.Number(columns_[0])};
    case SensorKind::kPose:
      return ReadPose();
    case SensorKind::kContacts:
      return models::ContactSample{ReadChannels<models::FootVector>()};
    case SensorKind::kTorques:
      return models::TorqueSample{ReadChannels<models::EncoderVector>()};
    case SensorKind::kFootForces:
      break;
  }
  return models::FootForceSample{ReadChannels<models::FootVector>()};
}

models::Sample CsvStream::ReadImu() {
  models::ImuSample sample;
  sample.gyro_rad_s = Vector(table_, {columns_[0], columns_[1], columns_[2]});
  sample.accel_m_s2 = Vector(table_, {columns_[3], columns_[4], columns_[5]});
  sample.interval_ns = Interval();
  return sample;
}

/// Angles alone give rates by difference; rates alone give no angles.
models::Sample CsvStream::ReadEncoders() {
  models::EncoderSample sample;
  const auto n = static_cast<Eigen::Index>(sensor_.channels.size());
  sample.angle_rad = models::EncoderVector::Zero(n);
  sample.rate_rad_s = models::EncoderVector::Zero(n);
  sample.interval_ns = Interval();
  const bool angles = !columns_.empty();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (angles) sample.angle_rad[i] = table_.Number(columns_[i]);
    if (!more_columns_.empty()) {
      sample.rate_rad_s[i] = table_.Number(more_columns_[i]);
    } else if (last_ns_ >= 0) {
      sample.rate_rad_s[i] =
          (sample.angle_rad[i] - last_angle_[i]) / models::Seconds(now_ns_ - last_ns_);
    }
  }
  last_angle_ = sample.angle_rad;
  return sample;
}

models::Sample CsvStream::ReadVelocity() const {
  models::BodyVelocitySample sample;
  sample.v_WS_S = Vector(table_, {columns_[0], columns_[1], columns_[2]});
  sample.covariance = sensor_.noise_m_per_s.cwiseAbs2().asDiagonal();
  sample.valid = !valid_ || table_.Number(*valid_) != 0.0;
  sample.over_ground = !over_ground_ || table_.Number(*over_ground_) != 0.0;
  if (more_columns_.empty()) return sample;
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j) {
      sample.covariance(i, j) = sample.covariance(j, i) = table_.Number(more_columns_[k++]);
    }
  }
  return sample;
}

models::Sample CsvStream::ReadPose() const {
  models::PoseSample sample;
  sample.X_WS.p = Vector(table_, {columns_[0], columns_[1], columns_[2]});
  sample.has_orientation = !more_columns_.empty();
  if (sample.has_orientation) {
    sample.X_WS.R =
        Rotation(table_, {more_columns_[0], more_columns_[1], more_columns_[2], more_columns_[3]});
  }
  sample.position_sigma_m = sensor_.noise_position_m;
  sample.orientation_sigma_rad = sensor_.noise_orientation_rad;
  return sample;
}

template <class Vector>
Vector CsvStream::ReadChannels() const {
  Vector values(static_cast<Eigen::Index>(columns_.size()));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = table_.Number(columns_[i]);
  }
  return values;
}

CsvTruth::CsvTruth(const std::filesystem::path& path)
    : table_(path),
      time_(NeedTime(table_, "t")),
      position_(Need3(table_, "p_", "_m")),
      velocity_(Need3(table_, "v_", "_m_s")),
      quaternion_{table_.Need("q_w"), table_.Need("q_x"), table_.Need("q_y"), table_.Need("q_z")},
      gyro_bias_(Find3(table_, "gyro_bias_", "_rad_s")),
      accel_bias_(Find3(table_, "accel_bias_", "_m_s2")) {
  Advance();
}

void CsvTruth::Advance() {
  now_.reset();
  if (!table_.Next()) return;
  ground_truth::Truth truth;
  truth.t_ns = time_.Of(table_);
  truth.X_WB = {Rotation(table_, quaternion_), Vector(table_, position_)};
  truth.v_WB = Vector(table_, velocity_);
  truth.has_biases = gyro_bias_ && accel_bias_;
  const Eigen::Vector3d unknown =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  truth.gyro_bias_rad_s = truth.has_biases ? Vector(table_, *gyro_bias_) : unknown;
  truth.accel_bias_m_s2 = truth.has_biases ? Vector(table_, *accel_bias_) : unknown;
  now_ = truth;
}

}  // namespace reckon::harness
