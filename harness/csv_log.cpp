#include "reckon/harness/csv_log.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "reckon/harness/beliefs.h"
#include "reckon/harness/csv_stream.h"

namespace reckon::harness {
namespace {

using ground_truth::Truth;
using models::TimeNs;

Eigen::Vector3d ToVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Truth ToTruth(const LogStart& start, TimeNs t_ns) {
  const auto& q = start.quaternion_wxyz;
  Truth truth;
  truth.t_ns = t_ns;
  truth.X_WB.R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  truth.X_WB.p = ToVector(start.position_m);
  truth.v_WB = ToVector(start.velocity_m_s);
  truth.gyro_bias_rad_s = ToVector(start.gyro_bias_rad_s);
  truth.accel_bias_m_s2 = ToVector(start.accel_bias_m_s2);
  return truth;
}

}  // namespace

CsvLog::CsvLog(const LoadedLog& log, const models::Suite& suite) : log_(log) {
  TimeNs first_ns = std::numeric_limits<TimeNs>::max();
  begin_ns_ = first_ns;
  for (std::size_t id = 0; id < suite.sensors.size(); ++id) {
    const LogSensor& sensor = log_.values.sensors.at(suite.sensors[id].name);
    streams_.push_back(std::make_unique<CsvStream>(log_.folder / sensor.file, sensor,
                                                   static_cast<models::SensorId>(id)));
    const auto& row = streams_.back()->now();
    if (!row) continue;
    first_ns = std::min(first_ns, row->valid_ns);
    if (const auto* imu = std::get_if<models::ImuSample>(&row->sample)) {
      begin_ns_ = std::min(begin_ns_, row->valid_ns - imu->interval_ns);
    }
  }
  if (begin_ns_ == std::numeric_limits<TimeNs>::max()) {
    Fail(log_.root.at, "the log has no IMU sample");
  }
  if (!log_.values.truth.empty()) {
    truth_ = std::make_unique<CsvTruth>(log_.folder / log_.values.truth);
    if (truth_->now()) first_ns = std::min(first_ns, truth_->now()->t_ns);
    if (truth_->now() && !log_.values.start) begin_ns_ = truth_->now()->t_ns;
  }
  begin_ns_ = std::max<TimeNs>(begin_ns_, 0);
  epoch_ns_ = std::min(first_ns, begin_ns_) / models::kNsPerSecond * models::kNsPerSecond;
}

CsvLog::~CsvLog() = default;

estimator::Prior CsvLog::Start(const InitialConfig& initial, std::uint64_t seed) {
  if (log_.values.start) {
    InitialConfig as_told = initial;
    as_told.sample_error = false;
    return DrawPrior(ToTruth(*log_.values.start, begin_ns_ - epoch_ns_), as_told, seed);
  }
  if (!truth_ || !truth_->now()) {
    Fail(log_.root.at, "expected a 'start' section or a 'truth' with rows: where does it begin?");
  }
  Truth truth = *truth_->now();
  truth.t_ns -= epoch_ns_;
  if (!truth.has_biases) {  // drawn about none, then
    truth.gyro_bias_rad_s.setZero();
    truth.accel_bias_m_s2.setZero();
  }
  return DrawPrior(truth, initial, seed);
}

std::optional<models::Measurement> CsvLog::Next() {
  for (;;) {
    CsvStream* earliest = nullptr;
    for (const auto& stream : streams_) {
      if (!stream->now()) continue;
      if (earliest == nullptr || stream->now()->arrival_ns < earliest->now()->arrival_ns) {
        earliest = stream.get();
      }
    }
    if (earliest == nullptr) return std::nullopt;
    models::Measurement measurement = *earliest->now();
    earliest->Advance();
    const bool imu = std::holds_alternative<models::ImuSample>(measurement.sample);
    if (measurement.valid_ns < begin_ns_ + (imu ? 1 : 0)) continue;
    measurement.valid_ns -= epoch_ns_;
    measurement.arrival_ns -= epoch_ns_;
    return measurement;
  }
}

std::optional<Truth> CsvLog::NextTruth() {
  if (!truth_) return std::nullopt;
  std::optional<Truth> truth = truth_->now();
  if (!truth) return std::nullopt;
  truth_->Advance();
  truth->t_ns -= epoch_ns_;
  return truth;
}

}  // namespace reckon::harness
