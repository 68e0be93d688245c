#include "reckon/sim/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>

namespace reckon::sim {
namespace {

constexpr double kOutlierProbability = 0.3;

/// Calls `visit(channel, value)` for every number that the sensor measures.
template <typename Visit>
void ForEachChannel(models::Sample& sample, const Visit& visit) {
  std::uint32_t channel = 0;
  const auto visit_all = [&](auto& vector) {
    for (double& value : vector) visit(channel++, value);
  };
  if (auto* imu = std::get_if<models::ImuSample>(&sample)) {
    visit_all(imu->gyro_rad_s);
    visit_all(imu->accel_m_s2);
  } else if (auto* encoders = std::get_if<models::EncoderSample>(&sample)) {
    visit_all(encoders->angle_rad);
    visit_all(encoders->rate_rad_s);
  } else if (auto* velocity = std::get_if<models::BodyVelocitySample>(&sample)) {
    visit_all(velocity->v_WS_S);
  }
}

void Saturate(models::Sample& sample, double limit) {
  if (auto* imu = std::get_if<models::ImuSample>(&sample)) {
    imu->gyro_saturated |= (imu->gyro_rad_s.array().abs() > limit).any();
    imu->accel_saturated |= (imu->accel_m_s2.array().abs() > limit).any();
  }
  ForEachChannel(sample,
                 [&](std::uint32_t, double& value) { value = std::clamp(value, -limit, limit); });
}

void AddOutlier(models::Sample& sample, double sigma, const RandomStream& draws,
                std::uint64_t index) {
  if (draws.Uniform(0, index) >= kOutlierProbability) return;
  ForEachChannel(sample, [&](std::uint32_t channel, double& value) {
    value += sigma * draws.Normal(channel, index);
  });
}

void Require(bool holds, const FaultConfig& fault, const char* field, double found,
             const char* allowed) {
  if (holds && std::isfinite(found)) return;
  std::ostringstream text;
  text << "fault " << FaultKindName(fault.kind) << " of sensor '" << fault.sensor << "': " << field
       << " is " << found << ", expected " << allowed;
  throw std::invalid_argument(text.str());
}

void Check(const FaultConfig& fault) {
  Require(fault.at_s >= 0.0 && fault.at_s < 1e9, fault, "at_s", fault.at_s, "at least 0");
  Require(fault.for_s > 0.0 && fault.for_s < 1e9, fault, "for_s", fault.for_s,
          "more than 0 and less than 1e9");
  const double x = fault.magnitude;
  switch (fault.kind) {
    case FaultKind::kSaturation:
    case FaultKind::kTimeJitter:
    case FaultKind::kOutlierBurst:
      return Require(x > 0.0 && x < 1e9, fault, "magnitude", x, "more than 0");
    case FaultKind::kExtraDelay:
      return Require(x > 0.0 && x < 1e6, fault, "magnitude", x, "more than 0 seconds, up to 1e6");
    default:
      return Require(true, fault, "magnitude", x, "a finite number");
  }
}

models::TimeNs Nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

std::string_view FaultKindName(FaultKind kind) {
  constexpr std::array<std::string_view, 9> kNames{"dropout",     "stuck",         "bias_step",
                                                   "scale_step",  "saturation",    "extra_delay",
                                                   "time_jitter", "outlier_burst", "nan_burst"};
  return kNames.at(static_cast<std::size_t>(kind));
}

FaultInjector::FaultInjector(std::string_view sensor, std::span<const FaultConfig> schedule,
                             std::uint64_t seed) {
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    const FaultConfig& fault = schedule[i];
    if (fault.sensor != sensor) continue;
    Check(fault);
    const std::string stream = "fault." + std::to_string(i) + "." + fault.sensor;
    faults_.push_back({fault.kind, Nanoseconds(fault.at_s), Nanoseconds(fault.at_s + fault.for_s),
                       fault.magnitude, RandomStream(seed, stream), std::nullopt});
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
      ForEachChannel(sample, [&](std::uint32_t, double& value) { value += magnitude; });
      break;
    case FaultKind::kScaleStep:
      ForEachChannel(sample, [&](std::uint32_t, double& value) { value *= magnitude; });
      break;
    case FaultKind::kSaturation:
      Saturate(sample, magnitude);
      break;
    case FaultKind::kExtraDelay:
      message.arrival_ns += Nanoseconds(magnitude);
      break;
    case FaultKind::kTimeJitter:
      message.valid_ns += Nanoseconds(magnitude * fault.draws.Normal(0, index_));
      break;
    case FaultKind::kOutlierBurst:
      AddOutlier(sample, magnitude, fault.draws, index_);
      break;
    case FaultKind::kNanBurst:
      ForEachChannel(sample, [](std::uint32_t, double& value) {
        value = std::numeric_limits<double>::quiet_NaN();
      });
      break;
  }
  return true;
}

}  // namespace reckon::sim
