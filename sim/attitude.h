#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::sim {

/// Heading of a body: the direction of its x axis over the horizontal plane, from W's x towards y.
inline double HeadingOf(const Eigen::Matrix3d& R_WB) { return std::atan2(R_WB(1, 0), R_WB(0, 0)); }

/// z along the normal of a ground that rises by `slope` (∂z/∂x, ∂z/∂y), and x forward over it, so
/// that the heading is 0.
inline Eigen::Matrix3d StandOn(const Eigen::Vector2d& slope) {
  Eigen::Matrix3d R;
  R.col(2) = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  R.col(0) = Eigen::Vector3d::UnitY().cross(R.col(2)).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

/// Whether a body's z axis leans by more than `angle_deg` from W's.
inline bool LeansBeyond(double angle_deg, const Eigen::Matrix3d& R_WB) {
  return R_WB(2, 2) < std::cos(angle_deg * std::numbers::pi / 180.0);
}

/// Whether a body leans by more than 75°, on its way to lie on its side or back.
inline bool IsOverturned(const Eigen::Matrix3d& R_WB) { return LeansBeyond(75.0, R_WB); }

}  // namespace reckon::sim
