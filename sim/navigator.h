#pragma once

#include <cstddef>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/sim/autopilot.h"
#include "reckon/sim/mission.h"

namespace reckon::sim {

/// Turns a mission into a course: towards the point 1 m ahead on the route, at
///     v = v₀ max(0.2, cos e),   e the error of heading,
/// slower where the route is steep (the vertical speed is clamp(0.4 Δz, ±0.2 m/s)) and towards the
/// end of a leg, where the vehicle holds its place with velocity 0.4 × the distance. The bow points
/// where it goes. Called at Autopilot::kRateHz.
class Navigator {
 public:
  /// Throws what LegsOf throws.
  explicit Navigator(const MissionConfig& mission);

  const std::vector<Leg>& legs() const { return legs_; }

  /// The course at `t_s` (negative before the run) for the vehicle at `X_WB`. Does not allocate.
  Course Update(double t_s, const models::Pose& X_WB);

 private:
  void AdvanceProgress(double t_s, const Eigen::Vector3d& p);
  Eigen::Vector2d HorizontalVelocity(const models::Pose& X_WB, const Eigen::Vector3d& target);

  double start_s_, speed_m_s_;
  std::vector<Leg> legs_;
  std::size_t leg_ = 0;
  double progress_m_ = 0.0;  ///< along the leg, never backwards
  double arrived_s_ = -1.0;  ///< at the end of the leg; negative: not yet
  double heading_rad_ = 0.0;
};

}  // namespace reckon::sim
