#pragma once

#include <optional>

#include <Eigen/Core>

#include "reckon/sim/path.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// What a driver asks of a planar base.
struct DriveCommand {
  double speed_m_s = 0.0, yaw_rate_rad_s = 0.0;
};

/// Follows the scenario's motion with the true pose: pure pursuit of the point 1 m ahead on the
/// path,
///     ω = clamp(1.5 e, ±1),   v = v0 max(0.2, cos e),   e the error of heading,
/// slowing down to stop at the end; or a velocity profile, open loop. Called at 50 Hz.
class Driver {
 public:
  static constexpr double kRateHz = 50.0;

  /// Throws std::invalid_argument, which names the key: no positive speed, size or number of laps,
  /// no waypoints, a profile that is empty or not sorted by time, numbers that are not finite.
  explicit Driver(const MotionConfig& motion);

  /// The command at time `t_s` for the robot at `p` with heading `yaw_rad`. Does not allocate.
  DriveCommand Update(double t_s, const Eigen::Vector2d& p, double yaw_rad);

 private:
  bool Pauses(double t_s) const;
  DriveCommand Follow(const Eigen::Vector2d& p, double yaw_rad);
  DriveCommand FromProfile(double t_s) const;
  void AdvanceProgress(const Eigen::Vector2d& p);

  MotionConfig motion_;
  std::optional<Path> path_;
  double end_m_ = 0.0;       // of the whole way
  double progress_m_ = 0.0;  // along it, never backwards
};

}  // namespace reckon::sim
