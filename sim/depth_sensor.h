#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/sim/environment.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// A pressure sensor: with z_S the height of its own origin in W, a sample is
///     y = r round((−z_S ρ/ρ_assumed + b + d + n) / r),   r = resolution_m,
/// unquantised if r is zero; b ~ N(0, offset_m²) is drawn once a run, the surface's drift d is a
/// random walk from zero, n is white with the configured σ per sample. Where the sensor's axes
/// point does not matter. Draws come from "<name>.noise" (index = sample), "<name>.drift"
/// (likewise) and "<name>.offset".
class DepthSensor : public Sensor {
 public:
  /// Throws std::invalid_argument for a negative or non-finite entry.
  DepthSensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
              const DepthConfig& config, std::uint64_t seed, const Environment& environment);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  Eigen::Vector3d p_BS_;
  SampleClock clock_;
  double sigma_, resolution_, offset_, gain_, drift_sigma_;
  double drift_ = 0.0;
  RandomStream noise_draws_, drift_draws_;
};

}  // namespace reckon::sim
