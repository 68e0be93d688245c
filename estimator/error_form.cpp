#include "reckon/estimator/error_form.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// ε = T ξ for right-invariant ξ.
ErrorCovariance FromRight(ErrorForm to, const NavigationState& x) {
  ErrorCovariance T = ErrorCovariance::Identity();
  if (to == ErrorForm::kRightInvariant) return T;
  const Matrix3d Rt = x.R.transpose();
  const Matrix3d turn = to == ErrorForm::kLeftInvariant ? Rt : Matrix3d::Identity();
  T.block<3, 3>(kTheta, kTheta) = Rt;
  T.block<3, 3>(kVelocity, kTheta) = -turn * Skew(x.v);
  T.block<3, 3>(kVelocity, kVelocity) = turn;
  T.block<3, 3>(kPosition, kTheta) = -turn * Skew(x.p);
  T.block<3, 3>(kPosition, kPosition) = turn;
  return T;
}

/// Its inverse: ξ = T⁻¹ ε.
ErrorCovariance ToRight(ErrorForm from, const NavigationState& x) {
  ErrorCovariance T = ErrorCovariance::Identity();
  if (from == ErrorForm::kRightInvariant) return T;
  const Matrix3d turn = from == ErrorForm::kLeftInvariant ? x.R : Matrix3d::Identity();
  T.block<3, 3>(kTheta, kTheta) = x.R;
  T.block<3, 3>(kVelocity, kTheta) = Skew(x.v) * x.R;
  T.block<3, 3>(kVelocity, kVelocity) = turn;
  T.block<3, 3>(kPosition, kTheta) = Skew(x.p) * x.R;
  T.block<3, 3>(kPosition, kPosition) = turn;
  return T;
}

}  // namespace

ErrorCovariance FormMap(ErrorForm from, ErrorForm to, const NavigationState& x) {
  return FromRight(to, x) * ToRight(from, x);
}

ErrorCovariance ConvertForm(const ErrorCovariance& P, ErrorForm from, ErrorForm to,
                            const NavigationState& x) {
  const ErrorCovariance T = FormMap(from, to, x);
  const ErrorCovariance moved = T * P * T.transpose();
  return 0.5 * (moved + moved.transpose());
}

ErrorVector ErrorBetween(ErrorForm form, const NavigationState& hat, const NavigationState& x) {
  const bool right = form == ErrorForm::kRightInvariant;
  Matrix3d turn = x.R.transpose() * hat.R;
  if (right) turn = hat.R * x.R.transpose();
  const Matrix3d carry = right ? turn : Matrix3d::Identity();
  const Vector3d theta = Log(turn);
  Vector3d dv = hat.v - carry * x.v;
  Vector3d dp = hat.p - carry * x.p;
  if (form != ErrorForm::kMultiplicative) {
    Matrix3d J_inverse = LeftJacobianInverse(theta);
    if (!right) J_inverse *= x.R.transpose();
    dv = J_inverse * dv;
    dp = J_inverse * dp;
  }
  ErrorVector error;
  error.segment<3>(0) = theta;
  error.segment<3>(3) = dv;
  error.segment<3>(6) = dp;
  error.segment<3>(9) = hat.gyro_bias - x.gyro_bias;
  error.segment<3>(12) = hat.accel_bias - x.accel_bias;
  return error;
}

}  // namespace reckon::estimator
