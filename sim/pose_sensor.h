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

/// An absolute pose of the sensor's own frame S in W:
///     p = p_WS + n_p,   R = Exp(n_R) R_WS,
/// both errors white with the configured σ per sample, along and about the axes of W. It delivers
/// those σ, but no σ below kLeastPoseSigma: filters need covariances that are positive. Without
/// orientation, R and its σ are left at identity and zero and say nothing.
/// Draws come from "<name>.position_noise" and "<name>.orientation_noise", channel = axis, index =
/// sample.
class PoseSensor : public Sensor {
 public:
  /// Throws std::invalid_argument for a negative or non-finite σ.
  PoseSensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
             const PoseConfig& config, std::uint64_t seed, models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  models::Pose X_BS_;
  SampleClock clock_;
  Eigen::Vector3d position_sigma_, orientation_sigma_;
  bool has_orientation_;
  RandomStream position_draws_, orientation_draws_;
};

/// The smallest standard deviation that a pose sensor delivers [m, rad].
inline constexpr double kLeastPoseSigma = 1e-6;

}  // namespace reckon::sim
