#include "reckon/estimator/pose_prior.h"

namespace reckon::estimator {

using Eigen::Matrix3d;

FirstState StateFromPose(const models::PoseSample& y, const models::Pose& X_IS, double scale,
                         const Prior& prior) {
  const models::Pose X_WI = y.X_WS * X_IS.Inverse();
  FirstState first{{}, prior.covariance};
  first.x.R = X_WI.R;
  first.x.p = X_WI.p;
  first.x.v = prior.v_WB;
  first.x.gyro_bias = prior.gyro_bias_rad_s;
  first.x.accel_bias = prior.accel_bias_m_s2;

  const Matrix3d P_theta = (scale * y.orientation_sigma_rad).cwiseAbs2().asDiagonal();
  const Matrix3d N_p = (scale * y.position_sigma_m).cwiseAbs2().asDiagonal();
  const Matrix3d N_v = prior.covariance.block<3, 3>(kVelocity, kVelocity);
  const Matrix3d q = Skew(y.X_WS.p), v = Skew(prior.v_WB);
  ErrorCovariance& P = first.P;
  P.topRows<9>().setZero();
  P.leftCols<9>().setZero();
  P.block<3, 3>(kTheta, kTheta) = P_theta;
  P.block<3, 3>(kVelocity, kTheta) = v * P_theta;
  P.block<3, 3>(kPosition, kTheta) = q * P_theta;
  P.block<3, 3>(kVelocity, kVelocity) = v * P_theta * v.transpose() + N_v;
  P.block<3, 3>(kPosition, kVelocity) = q * P_theta * v.transpose();
  P.block<3, 3>(kPosition, kPosition) = q * P_theta * q.transpose() + N_p;
  P = P.selfadjointView<Eigen::Lower>();
  return first;
}

}  // namespace reckon::estimator
