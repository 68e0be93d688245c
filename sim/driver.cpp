#include "reckon/sim/driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace reckon::sim {
namespace {

constexpr double kLookAhead = 1.0;     // m
constexpr double kSteeringGain = 1.5;  // 1/s
constexpr double kMaxYawRate = 1.0;    // rad/s
constexpr double kSearchWindow = 0.5;  // m, short of the distance to another branch of the path
constexpr double kSearchStep = 0.02;   // m
constexpr double kBraking = 0.5;       // m/s², below what the base can do
constexpr double kArrived = 0.02;      // m

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw std::invalid_argument("motion: " + sentence);
}

bool Positive(double value) { return value > 0 && std::isfinite(value); }

std::optional<Path> MakePath(const MotionConfig& motion) {
  switch (motion.path) {
    case PathKind::kSquare:
      return Path::Square(motion.side_m, motion.clockwise);
    case PathKind::kCircle:
      return Path::Circle(motion.radius_m, motion.clockwise);
    case PathKind::kFigureEight:
      return Path::FigureEight(motion.radius_m, motion.clockwise);
    case PathKind::kWaypoints:
      return Path::Waypoints(motion.waypoints_m);
    case PathKind::kStand:
    case PathKind::kVelocityProfile:
      break;
  }
  return std::nullopt;
}

void CheckProfile(const MotionConfig& motion) {
  Require(!motion.profile.empty(),
          "profile must hold at least one row [t_s, v_m_s, yaw_rate_rad_s]");
  for (std::size_t i = 0; i < motion.profile.size(); ++i) {
    const auto& [t, v, w] = motion.profile[i];
    Require(std::isfinite(t) && std::isfinite(v) && std::isfinite(w), "profile must be finite");
    Require(i == 0 || t > motion.profile[i - 1][0], "profile must be sorted by time");
  }
}

}  // namespace

Driver::Driver(const MotionConfig& motion) : motion_(motion), path_(MakePath(motion)) {
  Require(motion.start_s >= 0 && std::isfinite(motion.start_s), "start_s must not be negative");
  if (motion.path == PathKind::kVelocityProfile) CheckProfile(motion);
  if (!path_) return;
  Require(Positive(motion.speed_m_s), "speed_m_s must be positive");
  Require(!path_->closed() || Positive(motion.laps), "laps must be positive");
  end_m_ = path_->length() * (path_->closed() ? motion.laps : 1.0);
}

DriveCommand Driver::Update(double t_s, const Eigen::Vector2d& p, double yaw_rad) {
  if (t_s < motion_.start_s || Pauses(t_s)) return {};
  if (path_) return Follow(p, yaw_rad);
  if (motion_.path == PathKind::kVelocityProfile) return FromProfile(t_s);
  return {};
}

bool Driver::Pauses(double t_s) const {
  const double cycle = motion_.go_s + motion_.stop_s;
  return motion_.go_s > 0.0 && std::fmod(t_s - motion_.start_s, cycle) >= motion_.go_s;
}

DriveCommand Driver::Follow(const Eigen::Vector2d& p, double yaw_rad) {
  AdvanceProgress(p);
  const double remaining = end_m_ - progress_m_;
  if (remaining < kArrived) return {};
  const Eigen::Vector2d to_target = path_->At(progress_m_ + kLookAhead).p - p;
  const double error =
      std::remainder(std::atan2(to_target.y(), to_target.x()) - yaw_rad, 2 * std::numbers::pi);
  const double cruise = std::min(motion_.speed_m_s, std::sqrt(2 * kBraking * remaining));
  return {cruise * std::max(0.2, std::cos(error)),
          std::clamp(kSteeringGain * error, -kMaxYawRate, kMaxYawRate)};
}

/// Moves the progress to the nearest point of the path within a short window ahead.
void Driver::AdvanceProgress(const Eigen::Vector2d& p) {
  double best = (path_->At(progress_m_).p - p).squaredNorm();
  const double start = progress_m_;
  for (int i = 1; i * kSearchStep <= kSearchWindow; ++i) {
    const double s = std::min(start + i * kSearchStep, end_m_);
    const double distance = (path_->At(s).p - p).squaredNorm();
    if (distance < best) {
      best = distance;
      progress_m_ = s;
    }
  }
}

DriveCommand Driver::FromProfile(double t_s) const {
  DriveCommand command;
  for (const auto& [t, v, w] : motion_.profile) {
    if (t_s < t) break;
    command = {v, w};
  }
  return command;
}

}  // namespace reckon::sim
