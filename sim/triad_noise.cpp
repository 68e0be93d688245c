#include "reckon/sim/triad_noise.h"

#include <cmath>

#include "reckon/sim/sample_clock.h"

namespace reckon::sim {
namespace {

void Check(const std::string& sensor, const std::string& triad, const TriadErrors& errors) {
  const auto check = [&](const char* field, double value) {
    RequireNotNegative(sensor, triad + "." + field, value);
  };
  check("noise_density", errors.noise_density);
  check("bias_walk", errors.bias_walk);
  check("bias_instability", errors.bias_instability);
  check("turn_on_bias", errors.turn_on_bias);
  check("scale", errors.scale);
  check("misalignment", errors.misalignment);
  check("g_sensitivity", errors.g_sensitivity);
  check("range", errors.range);
  check("resolution", errors.resolution);
  if (!(errors.bias_time_constant_s > 0.0) || !std::isfinite(errors.bias_time_constant_s)) {
    RefuseField(sensor, triad + ".bias_time_constant_s", errors.bias_time_constant_s,
                "a finite number above 0");
  }
}

/// One standard normal draw for each axis.
Eigen::Vector3d Normals(const RandomStream& draws, std::uint64_t index) {
  return {draws.Normal(0, index), draws.Normal(1, index), draws.Normal(2, index)};
}

}  // namespace

TriadNoise::TriadNoise(const std::string& sensor, const std::string& triad,
                       const TriadErrors& errors, double dt_s, std::uint64_t seed)
    : noise_(errors.noise_density / std::sqrt(dt_s)),
      walk_(errors.bias_walk * std::sqrt(dt_s)),
      instability_(errors.bias_instability),
      phi_(std::exp(-dt_s / errors.bias_time_constant_s)),
      drive_(instability_ * std::sqrt(-std::expm1(-2.0 * dt_s / errors.bias_time_constant_s))),
      range_(errors.range),
      resolution_(errors.resolution),
      noise_draws_(seed, sensor + "." + triad + ".noise"),
      walk_draws_(seed, sensor + "." + triad + ".bias_walk"),
      instability_draws_(seed, sensor + "." + triad + ".bias_instability") {
  Check(sensor, triad, errors);
  const auto stream = [&](const char* error) {
    return RandomStream(seed, sensor + "." + triad + "." + error);
  };
  const RandomStream scale = stream("scale"), misalignment = stream("misalignment"),
                     g_sensitivity = stream("g_sensitivity");
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t j = 0; j < 3; ++j) {
      M_(i, j) += i == j ? errors.scale * scale.Normal(i, 0)
                         : errors.misalignment * misalignment.Normal(3 * i + j, 0);
      G_(i, j) = errors.g_sensitivity * g_sensitivity.Normal(3 * i + j, 0);
    }
  }
  turn_on_ = errors.turn_on_bias * Normals(stream("turn_on_bias"), 0);
  drifted_ = instability_ * Normals(instability_draws_, 0);
  bias_ = turn_on_ + drifted_;
}

TriadNoise::Reading TriadNoise::Read(const Eigen::Vector3d& x, const Eigen::Vector3d& f) {
  Reading reading{M_ * x + G_ * f + bias_};
  Eigen::Vector3d& y = reading.value;
  if (noise_ > 0.0) y += noise_ * Normals(noise_draws_, index_);
  if (range_ > 0.0) {
    reading.saturated = (y.array().abs() > range_).any();
    y = y.cwiseMax(-range_).cwiseMin(range_);
  }
  if (resolution_ > 0.0) y = resolution_ * (y / resolution_).array().round().matrix();
  ++index_;
  MoveBias();
  return reading;
}

void TriadNoise::MoveBias() {
  if (walk_ > 0.0) walked_ += walk_ * Normals(walk_draws_, index_);
  if (instability_ > 0.0) {
    drifted_ = phi_ * drifted_ + drive_ * Normals(instability_draws_, index_);
  }
  bias_ = turn_on_ + walked_ + drifted_;
}

}  // namespace reckon::sim
