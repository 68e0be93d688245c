#include "reckon/sim/navigator.h"

#include <algorithm>
#include <cmath>

#include "reckon/sim/attitude.h"

namespace reckon::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLookAhead = 1.0;     // m
constexpr double kSearchWindow = 1.0;  // m, less than the distance to another branch of the route
constexpr double kNear = 0.3;          // m: closer than this no heading follows from the target
constexpr double kHold = 0.4;          // 1/s: velocity towards a point for the distance to it
constexpr double kMaxClimb = 0.2;      // m/s
constexpr double kArrived = 0.25;      // m
constexpr double kSlowest = 0.2;       // of the speed, while it turns

}  // namespace

Navigator::Navigator(const MissionConfig& mission)
    : start_s_(mission.start_s), speed_m_s_(mission.speed_m_s), legs_(LegsOf(mission)) {}

void Navigator::AdvanceProgress(double t_s, const Vector3d& p) {
  const Leg& leg = legs_[leg_];
  progress_m_ = leg.route.Nearest(p, progress_m_, kSearchWindow);
  if (arrived_s_ < 0.0 && leg.route.length() - progress_m_ < kArrived) arrived_s_ = t_s;
  if (arrived_s_ < 0.0 || t_s - arrived_s_ < leg.hold_s || leg_ + 1 == legs_.size()) return;
  ++leg_;
  progress_m_ = 0.0;
  arrived_s_ = -1.0;
}

Vector2d Navigator::HorizontalVelocity(const models::Pose& X_WB, const Vector3d& target) {
  const Route& route = legs_[leg_].route;
  const Vector2d away = (target - X_WB.p).head<2>();
  const Vector3d along = route.Direction(progress_m_);
  const double remaining = route.length() - progress_m_;
  if (away.norm() < kNear || along.head<2>().norm() < 1e-3 || remaining < kLookAhead) {
    return std::min(kHold, speed_m_s_ / std::max(away.norm(), 1e-9)) * away;
  }
  heading_rad_ = std::atan2(away.y(), away.x());
  const double turned = std::max(kSlowest, std::cos(heading_rad_ - HeadingOf(X_WB.R)));
  const double steep = std::abs(along.z()) / along.head<2>().norm();
  const double cruise = std::min(speed_m_s_ * turned, kMaxClimb / std::max(steep, 1e-9));
  return cruise * away.normalized();
}

Course Navigator::Update(double t_s, const models::Pose& X_WB) {
  if (t_s >= start_s_) AdvanceProgress(t_s, X_WB.p);
  const double ahead = t_s >= start_s_ ? progress_m_ + kLookAhead : 0.0;
  const Vector3d target = legs_[leg_].route.At(ahead);
  Course course;
  course.velocity_m_s.head<2>() = HorizontalVelocity(X_WB, target);
  course.velocity_m_s.z() = std::clamp(kHold * (target.z() - X_WB.p.z()), -kMaxClimb, kMaxClimb);
  course.heading_rad = heading_rad_;
  return course;
}

}  // namespace reckon::sim
