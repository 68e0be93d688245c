#include "reckon/sim/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

namespace reckon::sim {
namespace {

constexpr double kOutlierProbability = 0.3;

/// Calls `visit(channel, value)` for every number that the sensor measures and that `channels`
/// names. A number keeps its channel whatever is chosen, and with it its draws.
template <typename Visit>
void ForEachChannel(models::Sample& sample, FaultChannels channels, const Visit& visit) {
  std::uint32_t channel = 0;
  const auto visit_all = [&](auto& vector, FaultChannels which) {
    const bool chosen = channels == FaultChannels::kAll || channels == which;
    for (double& value : vector) {
      if (chosen) visit(channel, value);
      ++channel;
    }
  };
  if (auto* imu = std::get_if<models::ImuSample>(&sample)) {
    visit_all(imu->gyro_rad_s, FaultChannels::kGyro);
    visit_all(imu->accel_m_s2, FaultChannels::kAccel);
  } else if (auto* encoders = std::get_if<models::EncoderSample>(&sample)) {
    visit_all(encoders->angle_rad, FaultChannels::kAngle);
    visit_all(encoders->rate_rad_s, FaultChannels::kRate);
  } else if (auto* velocity = std::get_if<models::BodyVelocitySample>(&sample)) {
    visit_all(velocity->v_WS_S, FaultChannels::kAll);
  } else if (auto* depth = std::get_if<models::DepthSample>(&sample)) {
    visit(channel, depth->depth_m);
  } else if (auto* pose = std::get_if<models::PoseSample>(&sample)) {
    visit_all(pose->X_WS.p, FaultChannels::kAll);
  } else if (auto* torques = std::get_if<models::TorqueSample>(&sample)) {
    visit_all(torques->torque_n_m, FaultChannels::kAll);
  } else if (auto* forces = std::get_if<models::FootForceSample>(&sample)) {
    visit_all(forces->force_n, FaultChannels::kAll);
  }
}

void Saturate(models::Sample& sample, FaultChannels channels, double limit) {
  if (auto* imu = std::get_if<models::ImuSample>(&sample)) {
    const auto clips = [limit](const Eigen::Vector3d& v) {
      return (v.array().abs() > limit).any();
    };
    imu->gyro_saturated |= channels != FaultChannels::kAccel && clips(imu->gyro_rad_s);
    imu->accel_saturated |= channels != FaultChannels::kGyro && clips(imu->accel_m_s2);
  }
  ForEachChannel(sample, channels,
                 [&](std::uint32_t, double& value) { value = std::clamp(value, -limit, limit); });
}

void AddOutlier(models::Sample& sample, FaultChannels channels, double sigma,
                const RandomStream& draws, std::uint64_t index) {
  if (draws.Uniform(0, index) >= kOutlierProbability) return;
  ForEachChannel(sample, channels, [&](std::uint32_t channel, double& value) {
    value += sigma * draws.Normal(channel, index);
  });
}

Range MagnitudeRange(FaultKind kind) {
  switch (kind) {
    case FaultKind::kBiasStep:
      return FaultConfig::kOffset;
    case FaultKind::kScaleStep:
      return FaultConfig::kFactor;
    case FaultKind::kSaturation:
      return FaultConfig::kLimit;
    case FaultKind::kExtraDelay:
      return FaultConfig::kDelay;
    case FaultKind::kTimeJitter:
      return FaultConfig::kJitter;
    case FaultKind::kOutlierBurst:
      return FaultConfig::kOutlier;
    case FaultKind::kDropout:
    case FaultKind::kStuck:
    case FaultKind::kNanBurst:
      break;  // no magnitude
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {-kInfinity, kInfinity};
}

void Check(const FaultConfig& fault) {
  const std::string what =
      "fault " + std::string(FaultKindName(fault.kind)) + " of sensor '" + fault.sensor + "'";
  RequireIn(FaultConfig::kStart, fault.at_s, what, "at_s");
  RequireIn(FaultConfig::kDuration, fault.for_s, what, "for_s");
  RequireIn(MagnitudeRange(fault.kind), fault.magnitude, what, "magnitude");
}

models::TimeNs Nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

std::string_view FaultKindName(FaultKind kind) {
  constexpr std::array<std::string_view, 9> kNames{"dropout",     "stuck",         "bias_step",
                                                   "scale_step",  "saturation",    "extra_delay",
                                                   "time_jitter", "outlier_burst", "nan_burst"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view FaultChannelsName(FaultChannels channels) {
  constexpr std::array<std::string_view, 5> kNames{"all", "gyro", "accel", "angle", "rate"};
  return kNames.at(static_cast<std::size_t>(channels));
}

bool HasChannels(const SensorErrors& sensor, FaultChannels channels) {
  switch (channels) {
    case FaultChannels::kAll:
      return true;
    case FaultChannels::kGyro:
    case FaultChannels::kAccel:
      return std::holds_alternative<ImuConfig>(sensor);
    case FaultChannels::kAngle:
    case FaultChannels::kRate:
      return std::holds_alternative<EncoderConfig>(sensor);
  }
  return false;
}

FaultInjector::FaultInjector(std::string_view sensor, std::span<const FaultConfig> schedule,
                             std::uint64_t seed) {
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    const FaultConfig& fault = schedule[i];
    if (fault.sensor != sensor) continue;
    Check(fault);
    const std::string stream = "fault." + std::to_string(i) + "." + fault.sensor;
    faults_.push_back({fault.kind, Nanoseconds(fault.at_s), Nanoseconds(fault.at_s + fault.for_s),
                       fault.magnitude, fault.channels, RandomStream(seed, stream), std::nullopt});
    jitters_ = jitters_ || fault.kind == FaultKind::kTimeJitter;
  }
}

bool FaultInjector::Apply(models::Measurement& message) {
  if (faults_.empty()) return true;
  const models::TimeNs true_ns = message.valid_ns;
  bool sent = true;
  for (Fault& fault : faults_) {
    const bool active = fault.begin_ns <= true_ns && true_ns < fault.end_ns;
    if (active && sent) sent = ApplyOne(fault, message);
    if (!active && sent && fault.kind == FaultKind::kStuck) fault.last_good = message.sample;
  }
  ++index_;
  if (sent && jitters_) {
    if (last_valid_ns_) message.valid_ns = std::max(message.valid_ns, *last_valid_ns_ + 1);
    last_valid_ns_ = message.valid_ns;
    message.arrival_ns = std::max(message.arrival_ns, message.valid_ns);
  }
  return sent;
}

bool FaultInjector::ApplyOne(Fault& fault, models::Measurement& message) const {
  const double magnitude = fault.magnitude;
  models::Sample& sample = message.sample;
  switch (fault.kind) {
    case FaultKind::kDropout:
      return false;
    case FaultKind::kStuck:
      if (!fault.last_good) fault.last_good = sample;
      sample = *fault.last_good;
      break;
    case FaultKind::kBiasStep:
      ForEachChannel(sample, fault.channels,
                     [&](std::uint32_t, double& value) { value += magnitude; });
      break;
    case FaultKind::kScaleStep:
      ForEachChannel(sample, fault.channels,
                     [&](std::uint32_t, double& value) { value *= magnitude; });
      break;
    case FaultKind::kSaturation:
      Saturate(sample, fault.channels, magnitude);
      break;
    case FaultKind::kExtraDelay:
      message.arrival_ns += Nanoseconds(magnitude);
      break;
    case FaultKind::kTimeJitter:
      message.valid_ns += Nanoseconds(magnitude * fault.draws.Normal(0, index_));
      break;
    case FaultKind::kOutlierBurst:
      AddOutlier(sample, fault.channels, magnitude, fault.draws, index_);
      break;
    case FaultKind::kNanBurst:
      ForEachChannel(sample, fault.channels, [](std::uint32_t, double& value) {
        value = std::numeric_limits<double>::quiet_NaN();
      });
      break;
  }
  return true;
}

}  // namespace reckon::sim
