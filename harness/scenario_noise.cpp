#include "reckon/harness/scenario_noise.h"

#include <cmath>

namespace reckon::harness {
namespace {

double Density(const sim::TriadErrors& errors, double rate_hz) {
  return std::sqrt(errors.noise_density * errors.noise_density +
                   errors.resolution * errors.resolution / (12.0 * rate_hz));
}

double Walk(const sim::TriadErrors& errors) {
  return std::sqrt(errors.bias_walk * errors.bias_walk + 2.0 * errors.bias_instability *
                                                             errors.bias_instability /
                                                             errors.bias_time_constant_s);
}

/// The first sensor of a type, by name; null if there is none.
template <class Config>
const Config* First(const Scenario& scenario) {
  for (const auto& [name, sensor] : scenario.sensors) {
    if (const auto* config = std::get_if<Config>(&sensor.errors)) return config;
  }
  return nullptr;
}

}  // namespace

estimator::Noise MatchedNoise(const Scenario& scenario) {
  estimator::Noise noise = scenario.nominal.noise;
  noise.body_velocity_scale = 1.0;
  noise.pose_scale = 1.0;
  if (const auto* imu = First<sim::ImuConfig>(scenario)) {
    noise.gyro_noise_density_rad_per_s_sqrt_hz = Density(imu->gyro, imu->timing.rate_hz);
    noise.accel_noise_density_m_per_s2_sqrt_hz = Density(imu->accel, imu->timing.rate_hz);
    noise.gyro_bias_walk_rad_per_s2_sqrt_hz = Walk(imu->gyro);
    noise.accel_bias_walk_m_per_s3_sqrt_hz = Walk(imu->accel);
  }
  if (const auto* depth = First<sim::DepthConfig>(scenario)) {
    noise.depth_m = std::sqrt(depth->noise_m * depth->noise_m +
                              depth->resolution_m * depth->resolution_m / 12.0);
  }
  return noise;
}

}  // namespace reckon::harness
