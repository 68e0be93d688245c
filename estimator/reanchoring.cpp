#include "reckon/estimator/reanchoring.h"

#include <Eigen/Geometry>
#include <numbers>

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTilt = 0.2;                                        ///< rad
constexpr double kYaw = std::numbers::pi * std::numbers::inv_sqrt3;  ///< rad: uniform
constexpr double kSpeed = 3.0;                                       ///< m/s

}  // namespace

Reanchored Reanchor(const NavigationState& before, const ErrorCovariance& P,
                    const ProcessNoise& noise, const Vector3d& up_I, double gap_s) {
  Reanchored after{before, ErrorCovariance::Zero()};
  after.x.v.setZero();
  const Vector3d up_W = before.R * (up_I - before.accel_bias);
  after.x.R = Eigen::Quaterniond::FromTwoVectors(up_W, Vector3d::UnitZ()) * before.R;

  const Matrix3d P_theta = Vector3d(kTilt, kTilt, kYaw).cwiseAbs2().asDiagonal();
  const Matrix3d p_cross = Skew(before.p);  // ξ_p = δp + [p̂]× θ
  ErrorCovariance& Q = after.P;
  Q.block<3, 3>(kTheta, kTheta) = P_theta;
  Q.block<3, 3>(kPosition, kTheta) = p_cross * P_theta;
  Q.block<3, 3>(kTheta, kPosition) = P_theta * p_cross.transpose();
  Q.block<3, 3>(kPosition, kPosition) = p_cross * P_theta * p_cross.transpose();
  Q.diagonal().segment<3>(kPosition).array() += kSpeed * kSpeed * gap_s * gap_s;
  Q.diagonal().segment<3>(kVelocity).setConstant(kSpeed * kSpeed);
  Q.block<6, 6>(kGyroBias, kGyroBias) = P.block<6, 6>(kGyroBias, kGyroBias);
  Q.diagonal().segment<3>(kGyroBias).array() += noise.gyro_walk * gap_s;
  Q.diagonal().segment<3>(kAccelBias).array() += noise.accel_walk * gap_s;
  return after;
}

}  // namespace reckon::estimator
