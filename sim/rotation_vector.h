#pragma once

#include <Eigen/Core>

namespace reckon::sim {

/// Exponential map of a rotation vector [rad], and its inverse (angle below π).
Eigen::Matrix3d RotationExp(const Eigen::Vector3d& phi);
Eigen::Vector3d RotationLog(const Eigen::Matrix3d& R);

/// Γ1(φ) = Σ [φ]×ⁿ / (n+1)!: the mean of Exp(sφ) over s in [0, 1]. Takes a specific force, constant
/// in the axes of a body that turns by φ, to the velocity that it adds. |φ| < 2π for the inverse.
Eigen::Matrix3d Gamma1(const Eigen::Vector3d& phi);
Eigen::Matrix3d Gamma1Inverse(const Eigen::Vector3d& phi);

}  // namespace reckon::sim
