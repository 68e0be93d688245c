#include "reckon/estimator/multiplicative_ekf.h"

#include "reckon/estimator/error_form.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void MultiplicativeEkf::Start(const NavigationState& x, const ErrorCovariance& P_right_invariant) {
  x_ = x;
  P_ = ConvertForm(P_right_invariant, ErrorForm::kRightInvariant, kForm, x);
}

void MultiplicativeEkf::Propagate(const Increment& u, const Vector3d& g,
                                  const ProcessNoise& noise) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  const Matrix3d R = x_.R;
  x_ = Propagated(x_, u, g);

  using Jacobian = Eigen::Matrix<double, 9, 9>;
  using BiasJacobian = Eigen::Matrix<double, 9, 6>;
  Jacobian F = Jacobian::Identity();
  F.block<3, 3>(kTheta, kTheta) = u.G0.transpose();
  F.block<3, 3>(kVelocity, kTheta) = -dt * R * Skew(u.G1 * u.a);
  F.block<3, 3>(kPosition, kTheta) = -dt2 * R * Skew(u.G2 * u.a);
  F.block<3, 3>(kPosition, kVelocity) = dt * Matrix3d::Identity();
  BiasJacobian J = BiasJacobian::Zero();
  J.block<3, 3>(kTheta, 0) = -dt * u.G0.transpose() * u.G1;
  J.block<3, 3>(kVelocity, 0) = -dt2 * R * GammaDerivative(1, u.phi, u.a);
  J.block<3, 3>(kPosition, 0) = -dt2 * dt * R * GammaDerivative(2, u.phi, u.a);
  J.block<3, 3>(kVelocity, 3) = -dt * R * u.G1;
  J.block<3, 3>(kPosition, 3) = -dt2 * R * u.G2;

  Eigen::Matrix<double, 6, 1> q;
  q << Vector3d::Constant(noise.gyro / dt), Vector3d::Constant(noise.accel / dt);
  const Jacobian P_xx = P_.block<9, 9>(kTheta, kTheta);
  const BiasJacobian P_xb = P_.block<9, 6>(kTheta, kGyroBias);
  const Eigen::Matrix<double, 6, 6> P_bb = P_.block<6, 6>(kGyroBias, kGyroBias);
  const BiasJacobian FP_xb = F.lazyProduct(P_xb);
  const BiasJacobian U = FP_xb + J.lazyProduct(P_bb);
  const Jacobian cross = FP_xb.lazyProduct(J.transpose());
  const Eigen::Matrix<double, 6, 6> held = P_bb + Eigen::Matrix<double, 6, 6>(q.asDiagonal());
  const Jacobian FP = F.lazyProduct(P_xx);
  const BiasJacobian JB = J.lazyProduct(held);
  Jacobian next = FP.lazyProduct(F.transpose());
  next += cross + cross.transpose();
  next += JB.lazyProduct(J.transpose());
  P_.block<9, 9>(kTheta, kTheta) = 0.5 * (next + next.transpose());
  P_.block<9, 6>(kTheta, kGyroBias) = U;
  P_.block<6, 9>(kGyroBias, kTheta) = U.transpose();
  P_.diagonal().segment<3>(kGyroBias).array() += noise.gyro_walk * dt;
  P_.diagonal().segment<3>(kAccelBias).array() += noise.accel_walk * dt;
}

Linearisation MultiplicativeEkf::Convert(const Linearisation& m, const NavigationState& x) {
  Linearisation converted;
  converted.z = m.z;
  converted.N = m.N;
  Matrix3d H_theta = Matrix3d::Zero();
  for (const Block& b : m.blocks()) {
    if (b.slot == kTheta) H_theta += b.H * x.R;
    if (b.slot == kVelocity) H_theta += b.H * Skew(x.v) * x.R;
    if (b.slot == kPosition) H_theta += b.H * Skew(x.p) * x.R;
    if (b.slot != kTheta) converted.Add(b.slot, b.H);
  }
  converted.Add(kTheta, H_theta);
  return converted;
}

void MultiplicativeEkf::Retract(const ErrorVector& increment) {
  x_.R = x_.R * Exp(increment.segment<3>(kTheta));
  x_.v += increment.segment<3>(kVelocity);
  x_.p += increment.segment<3>(kPosition);
  x_.gyro_bias += increment.segment<3>(kGyroBias);
  x_.accel_bias += increment.segment<3>(kAccelBias);
}

ErrorCovariance MultiplicativeEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& w,
                                                  double gyro_variance) const {
  const Matrix3d A = x_.R * Skew(r_IB);
  ErrorCovariance T = ErrorCovariance::Identity();
  T.block<3, 3>(kPosition, kTheta) = -A;
  T.block<3, 3>(kVelocity, kTheta) = -x_.R * Skew(w.cross(r_IB));
  T.block<3, 3>(kVelocity, kGyroBias) = A;
  ErrorCovariance P = T * P_ * T.transpose();
  P.block<3, 3>(kVelocity, kVelocity) += gyro_variance * A * A.transpose();
  return P;
}

}  // namespace reckon::estimator
