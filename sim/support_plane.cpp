#include "reckon/sim/support_plane.h"

#include <Eigen/LU>
#include <algorithm>

namespace reckon::sim {
namespace {

constexpr double kSlopeTime = 0.15, kHeightTime = 0.05;  // s
constexpr double kSteepest = 0.5;
/// Beside the feet's spread [m²]: feet in a line say nothing of the slope across it.
constexpr double kRidge = 1e-3;

}  // namespace

SupportPlane::Fit SupportPlane::FitTo(const Points& feet, const Eigen::Vector2d& p) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < feet_; ++i) mean += feet[i] / feet_;
  Eigen::Matrix2d spread = kRidge * Eigen::Matrix2d::Identity();
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();
  for (int i = 0; i < feet_; ++i) {
    const Eigen::Vector3d r = feet[i] - mean;
    spread += r.head<2>() * r.head<2>().transpose();
    rise += r.head<2>() * r.z();
  }
  Eigen::Vector2d slope = spread.inverse() * rise;
  slope = slope.cwiseMax(-kSteepest).cwiseMin(kSteepest);
  return {slope, mean.z() + slope.dot(p - mean.head<2>())};
}

void SupportPlane::Start(const Points& feet, const Eigen::Vector2d& p) {
  const Fit fit = FitTo(feet, p);
  slope_ = fit.slope;
  height_ = fit.height;
  p_ = p;
}

void SupportPlane::Update(const Points& feet, const Eigen::Vector2d& p, double dt_s) {
  const Fit fit = FitTo(feet, p);
  slope_ += std::min(1.0, dt_s / kSlopeTime) * (fit.slope - slope_);
  height_ += slope_.dot(p - p_);  // the robot moved over the plane
  height_ += std::min(1.0, dt_s / kHeightTime) * (fit.height - height_);
  p_ = p;
}

}  // namespace reckon::sim
