#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// An ideal sensor of velocity: y = R_WSᵀ v_S + n with v_S the central difference of its origin, in
/// its own axes, and n white with the configured σ per sample; it delivers diag(σ²) as covariance.
/// Draws come from "<name>.noise", channel = axis, index = sample.
class BodyVelocitySensor : public Sensor {
 public:
  /// Throws std::invalid_argument for a negative or non-finite σ.
  BodyVelocitySensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
                     const BodyVelocityConfig& config, std::uint64_t seed,
                     models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  models::Pose X_BS_;
  SampleClock clock_;
  Eigen::Vector3d sigma_;
  RandomStream noise_draws_;
};

}  // namespace reckon::sim
