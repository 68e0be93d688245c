#include "reckon/ground_truth/estimate_error.h"

#include <Eigen/Geometry>
#include <cmath>

namespace reckon::ground_truth {
namespace {

Eigen::Vector3d Log(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sine = q.vec().norm();
  const double angle = 2.0 * std::atan2(q.w() < 0.0 ? -sine : sine, std::abs(q.w()));
  return sine > 1e-12 ? Eigen::Vector3d(q.vec() * (angle / sine)) : Eigen::Vector3d(2.0 * q.vec());
}

/// J⁻¹(θ) u, J the left Jacobian of SO(3).
Eigen::Vector3d InverseJacobianTimes(const Eigen::Vector3d& theta, const Eigen::Vector3d& u) {
  const double x = theta.squaredNorm();
  const double angle = std::sqrt(x);
  const double c =
      angle > 1e-2 ? (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / x : 1.0 / 12.0 + x / 720.0;
  return u - 0.5 * theta.cross(u) + c * theta.cross(theta.cross(u));
}

}  // namespace

estimator::ErrorVector EstimateError(const Truth& truth, const estimator::Estimate& estimate) {
  const Eigen::Matrix3d &R = truth.X_WB.R, &Rh = estimate.X_WB.R;
  const Eigen::Vector3d &v = truth.v_WB, &vh = estimate.v_WB;
  const Eigen::Vector3d &p = truth.X_WB.p, &ph = estimate.X_WB.p;
  estimator::ErrorVector error;
  auto theta = error.segment<3>(estimator::kTheta);
  auto velocity = error.segment<3>(estimator::kVelocity);
  auto position = error.segment<3>(estimator::kPosition);
  switch (estimate.form) {
    case estimator::ErrorForm::kRightInvariant: {
      const Eigen::Matrix3d dR = Rh * R.transpose();
      theta = Log(dR);
      velocity = InverseJacobianTimes(theta, vh - dR * v);
      position = InverseJacobianTimes(theta, ph - dR * p);
      break;
    }
    case estimator::ErrorForm::kLeftInvariant:
      theta = Log(R.transpose() * Rh);
      velocity = InverseJacobianTimes(theta, R.transpose() * (vh - v));
      position = InverseJacobianTimes(theta, R.transpose() * (ph - p));
      break;
    case estimator::ErrorForm::kMultiplicative:
      theta = Log(R.transpose() * Rh);
      velocity = vh - v;
      position = ph - p;
      break;
  }
  error.segment<3>(estimator::kGyroBias) = estimate.gyro_bias_rad_s - truth.gyro_bias_rad_s;
  error.segment<3>(estimator::kAccelBias) = estimate.accel_bias_m_s2 - truth.accel_bias_m_s2;
  return error;
}

}  // namespace reckon::ground_truth
