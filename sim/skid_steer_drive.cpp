#include "reckon/sim/skid_steer_drive.h"

#include <algorithm>
#include <cassert>

namespace reckon::sim {
namespace {

double Ramp(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

SkidSteerDrive::SkidSteerDrive(const SkidSteerConfig& config)
    : config_(config),
      left_(static_cast<int>(config.left_joints.size())),
      right_(static_cast<int>(config.right_joints.size())),
      integral_gain_(config.speed_ki) {}

models::EncoderVector SkidSteerDrive::Update(const DriveCommand& command,
                                             const models::EncoderVector& angle_rad,
                                             const models::EncoderVector& rate_rad_s, double dt_s) {
  assert(angle_rad.size() == left_ + right_ && rate_rad_s.size() == left_ + right_);
  ramped_.speed_m_s =
      Ramp(ramped_.speed_m_s, command.speed_m_s, config_.max_acceleration_m_s2 * dt_s);
  ramped_.yaw_rate_rad_s = Ramp(ramped_.yaw_rate_rad_s, command.yaw_rate_rad_s,
                                config_.max_yaw_acceleration_rad_s2 * dt_s);
  models::EncoderVector torque(left_ + right_);
  for (int side = 0; side < 2; ++side) {
    const int first = side == 0 ? 0 : left_, count = side == 0 ? left_ : right_;
    const double arm = (side == 0 ? -0.5 : 0.5) * config_.command_track_m;
    const double target =
        (ramped_.speed_m_s + arm * ramped_.yaw_rate_rad_s) / config_.wheel_radius_m;
    const double angle = angle_rad.segment(first, count).mean();
    const double rate = rate_rad_s.segment(first, count).mean();
    const double motor = MotorTorque(target - rate, dt_s, integral_n_m_[side]);
    for (int i = first; i < first + count; ++i) {
      torque(i) = motor - config_.belt_stiffness_n_m_rad * (angle_rad(i) - angle) -
                  config_.belt_damping_n_m_s * (rate_rad_s(i) - rate) -
                  config_.wheel_damping_n_m_s * rate_rad_s(i);
    }
  }
  return torque;
}

/// PI with conditional integration: the integral stands still while the output is at its limit and
/// the error would push it further.
double SkidSteerDrive::MotorTorque(double speed_error_rad_s, double dt_s,
                                   double& integral_n_m) const {
  const double limit = config_.torque_limit_n_m;
  const double raw = config_.speed_kp * speed_error_rad_s + integral_n_m;
  const bool pushing =
      (raw >= limit && speed_error_rad_s > 0) || (raw <= -limit && speed_error_rad_s < 0);
  if (!pushing) integral_n_m += integral_gain_ * speed_error_rad_s * dt_s;
  return std::clamp(raw, -limit, limit);
}

}  // namespace reckon::sim
