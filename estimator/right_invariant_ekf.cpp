#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void RightInvariantEkf::Propagate(const Increment& u, const Vector3d& g,
                                  const ProcessNoise& noise) {
  const double dt = u.dt;
  const Matrix3d R = x_.R;
  x_ = Propagated(x_, u, g);

  // Gravity and velocity; the position first, it reads the old velocity.
  const Lane g_dt = ToLane(g * dt), half_g_dt2 = ToLane(0.5 * dt * dt * g);
  P_.AddRow(
      kPositionSlot, [dt](const LaneMatrix& v) { return dt * v; }, kVelocitySlot);
  P_.AddRow(
      kPositionSlot, [half_g_dt2](const LaneMatrix& theta) { return Cross(half_g_dt2, theta); },
      kThetaSlot);
  P_.AddRow(
      kVelocitySlot, [g_dt](const LaneMatrix& theta) { return Cross(g_dt, theta); }, kThetaSlot);

  // Biases, and the noise of the sample.
  BiasColumns J;
  const LaneMatrix R_dt = ToLanes(dt * R);
  const LaneMatrix theta_g = -1.0 * (R_dt * ToLanes(u.G1));
  J.gyro[kThetaSlot] = theta_g;
  J.gyro[kVelocitySlot] =
      Cross(ToLane(x_.v), theta_g) - R_dt * ToLanes(dt * u.series.GammaDerivative(1, u.a));
  J.gyro[kPositionSlot] =
      Cross(ToLane(x_.p), theta_g) - R_dt * ToLanes(dt * dt * u.series.GammaDerivative(2, u.a));
  J.accel_velocity = theta_g;
  J.accel_position = -1.0 * (R_dt * ToLanes(dt * u.G2));
  for (const Slot slot : P_.active()) {
    if (IsFoot(slot)) J.gyro[slot] = Cross(ToLane(x_.At(slot)), theta_g);
  }
  P_.AddBiases(J, noise.gyro / (2.0 * dt), noise.accel / (2.0 * dt));
  P_.AddDiagonal(kGyroBiasSlot, noise.gyro_walk * dt);
  P_.AddDiagonal(kAccelBiasSlot, noise.accel_walk * dt);
}

void RightInvariantEkf::Retract(const SlotVector& increment) {
  const RotationSeries theta(ToEigen(increment[kThetaSlot]));
  const Matrix3d turn = theta.Gamma(0);
  const Matrix3d J = theta.Gamma(1);
  x_.R = turn * x_.R;
  for (const Slot slot : P_.active()) {
    if (slot == kThetaSlot || slot >= kGyroBiasSlot) continue;
    x_.At(slot) = turn * x_.At(slot) + J * ToEigen(increment[slot]);
  }
  x_.gyro_bias += ToEigen(increment[kGyroBiasSlot]);
  x_.accel_bias += ToEigen(increment[kAccelBiasSlot]);
}

ErrorCovariance RightInvariantEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& /*w*/,
                                                  double gyro_variance) const {
  // θ and position keep their form; ξ_vB = ξ_v + R [r]× ζ_g, and the gyroscope's own noise.
  const Matrix3d A = x_.R * Skew(r_IB);
  const ErrorCovariance dense = P_.Dense();
  ErrorCovariance P = dense;
  P.middleRows<3>(kVelocity) += A * dense.middleRows<3>(kGyroBias);
  P.middleCols<3>(kVelocity) += P.middleCols<3>(kGyroBias).eval() * A.transpose();
  P.block<3, 3>(kVelocity, kVelocity) += gyro_variance * A * A.transpose();
  return P;
}

}  // namespace reckon::estimator
