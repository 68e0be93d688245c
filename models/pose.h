#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::models {

/// A rigid transform X_AB: the rotation `R` takes B's coordinates to A's, `p` is B's origin in A
/// [m]. Adjacent letters must match in a product: X_AC = X_AB * X_BC.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();

  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, R * X_BC.p + p}; }
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_BQ) const { return R * p_BQ + p; }
  Pose Inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

}  // namespace reckon::models
