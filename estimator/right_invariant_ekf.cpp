#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void RightInvariantEkf::Propagate(const Increment& u, const Vector3d& g,
                                  const ProcessNoise& noise) {
  const double dt = u.dt;
  const Matrix3d R = x_.R;
  x_ = Propagated(x_, u, g);

  // Gravity and velocity, rows then columns: position first, it reads the old velocity.
  const Matrix3d g_dt = Skew(g) * dt;
  P_.middleRows<3>(kPosition) += dt * P_.middleRows<3>(kVelocity);
  P_.middleRows<3>(kPosition) += (0.5 * dt * g_dt).lazyProduct(P_.middleRows<3>(kTheta));
  P_.middleRows<3>(kVelocity) += g_dt.lazyProduct(P_.middleRows<3>(kTheta));
  P_.middleCols<3>(kPosition) += dt * P_.middleCols<3>(kVelocity);
  P_.middleCols<3>(kPosition) -= P_.middleCols<3>(kTheta).lazyProduct(0.5 * dt * g_dt);
  P_.middleCols<3>(kVelocity) -= P_.middleCols<3>(kTheta).lazyProduct(g_dt);

  // The bias columns of Φ.
  Eigen::Matrix<double, 9, 6> J;
  const Matrix3d theta_g = -dt * R * u.G1;
  J.block<3, 3>(kTheta, 0) = theta_g;
  J.block<3, 3>(kVelocity, 0) =
      Skew(x_.v) * theta_g - (dt * dt) * R * GammaDerivative(1, u.phi, u.a);
  J.block<3, 3>(kPosition, 0) =
      Skew(x_.p) * theta_g - (dt * dt * dt) * R * GammaDerivative(2, u.phi, u.a);
  J.block<3, 3>(kTheta, 3).setZero();
  J.block<3, 3>(kVelocity, 3) = theta_g;
  J.block<3, 3>(kPosition, 3) = -(dt * dt) * R * u.G2;

  // P_xx += W Jᵀ + J Wᵀ with W = (U + U′)/2 + J Q/(2Δt): biases and the held sample's noise at
  // once.
  Eigen::Matrix<double, 6, 1> q;
  q << Vector3d::Constant(noise.gyro / (2.0 * dt)), Vector3d::Constant(noise.accel / (2.0 * dt));
  const Eigen::Matrix<double, 9, 6> U = P_.block<9, 6>(kTheta, kGyroBias);
  const Eigen::Matrix<double, 9, 6> U_next =
      U + J.lazyProduct(P_.block<6, 6>(kGyroBias, kGyroBias));
  const Eigen::Matrix<double, 9, 6> W = 0.5 * (U + U_next) + J * q.asDiagonal();
  const Eigen::Matrix<double, 9, 9> WJt = W.lazyProduct(J.transpose());
  P_.block<9, 9>(kTheta, kTheta) += WJt + WJt.transpose();
  P_.block<9, 6>(kTheta, kGyroBias) = U_next;
  P_.block<6, 9>(kGyroBias, kTheta) = U_next.transpose();

  P_.diagonal().segment<3>(kGyroBias).array() += noise.gyro_walk * dt;
  P_.diagonal().segment<3>(kAccelBias).array() += noise.accel_walk * dt;
}

void RightInvariantEkf::Retract(const ErrorVector& increment) {
  const Vector3d theta = increment.segment<3>(kTheta);
  const Matrix3d turn = Exp(theta);
  const Matrix3d J = LeftJacobian(theta);
  x_.R = turn * x_.R;
  x_.v = turn * x_.v + J * increment.segment<3>(kVelocity);
  x_.p = turn * x_.p + J * increment.segment<3>(kPosition);
  x_.gyro_bias += increment.segment<3>(kGyroBias);
  x_.accel_bias += increment.segment<3>(kAccelBias);
}

ErrorCovariance RightInvariantEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& /*w*/,
                                                  double gyro_variance) const {
  // θ and position keep their form; ξ_vB = ξ_v + R [r]× ζ_g, and the gyroscope's own noise.
  const Matrix3d A = x_.R * Skew(r_IB);
  ErrorCovariance P = P_;
  P.middleRows<3>(kVelocity) += A * P_.middleRows<3>(kGyroBias);
  P.middleCols<3>(kVelocity) += P.middleCols<3>(kGyroBias).eval() * A.transpose();
  P.block<3, 3>(kVelocity, kVelocity) += gyro_variance * A * A.transpose();
  return P;
}

}  // namespace reckon::estimator
