#pragma once

#include "reckon/models/encoder_sample.h"
#include "reckon/sim/driver.h"
#include "reckon/sim/robot_config.h"

namespace reckon::sim {

/// The motors of a skid-steer: one a side, whose wheels a belt turns together. The command is
/// ramped, turned into wheel speeds ω = (v ∓ r B/2)/R with the nominal radius R and track B, and
/// held by a PI loop on the side's mean speed, without windup. The loop's torque acts on each wheel
/// of the side, and its limit is that of one wheel.
///
/// Wheels are ordered left front to rear, then right front to rear.
class SkidSteerDrive {
 public:
  explicit SkidSteerDrive(const SkidSteerConfig& config);

  /// The parking brake: the integral gain is raised so that the wheels hold their place while the
  /// robot comes to rest. Releasing it is without a bump, since the integrator is a torque.
  void SetBrake(bool on) { integral_gain_ = on ? kBrakeGain : config_.speed_ki; }

  /// Torques on the wheels [N m] for `command` and the wheels' state. Does not allocate.
  models::EncoderVector Update(const DriveCommand& command, const models::EncoderVector& angle_rad,
                               const models::EncoderVector& rate_rad_s, double dt_s);

 private:
  static constexpr double kBrakeGain = 2000.0;  // N m per rad

  double MotorTorque(double speed_error_rad_s, double dt_s, double& integral_n_m) const;

  SkidSteerConfig config_;
  int left_, right_;  // wheels a side
  double integral_gain_;
  DriveCommand ramped_;
  double integral_n_m_[2] = {0.0, 0.0};  // left, right
};

}  // namespace reckon::sim
