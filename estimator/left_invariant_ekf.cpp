#include "reckon/estimator/left_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void LeftInvariantEkf::Propagate(const Increment& u, const Vector3d& g, const ProcessNoise& noise) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  x_ = Propagated(x_, u, g);

  // In the axes of before the step: position first, it reads the old velocity. Then all turn.
  const Lane dv = ToLane(-dt * (u.G1 * u.a)), dp = ToLane(-dt2 * (u.G2 * u.a));
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, CrossProduct{dp}, kThetaSlot);
  P_.AddRow(kVelocitySlot, CrossProduct{dv}, kThetaSlot);
  const Matrix3d turn = u.G0.transpose();
  const LaneMatrix turn_lanes = ToLanes(turn);
  for (const Slot slot : P_.active()) {
    if (slot < kGyroBiasSlot) P_.MapRow(slot, turn_lanes);
  }

  BiasColumns J;
  J.gyro[kThetaSlot] = ToLanes(-dt * turn * u.G1);
  J.gyro[kVelocitySlot] = ToLanes(-dt2 * turn * u.series.GammaDerivative(1, u.a));
  J.gyro[kPositionSlot] = ToLanes(-dt2 * dt * turn * u.series.GammaDerivative(2, u.a));
  J.accel_velocity = J.gyro[kThetaSlot];
  J.accel_position = ToLanes(-dt2 * turn * u.G2);
  P_.AddBiases(J, noise, dt);
}

void LeftInvariantEkf::Retract(const SlotVector& increment) {
  const RotationSeries theta(ToEigen(increment[kThetaSlot]));
  const Matrix3d RJ = x_.R * theta.Gamma(1);
  for (const Slot slot : P_.active()) {
    if (slot == kThetaSlot || slot >= kGyroBiasSlot) continue;
    x_.At(slot) += RJ * ToEigen(increment[slot]);
  }
  x_.R = x_.R * theta.Gamma(0);
  RetractBiases(increment);
}

ErrorCovariance LeftInvariantEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& w,
                                                 double gyro_variance) const {
  Covariance P = P_;
  AddTurnOfLeverArm(P, Matrix3d::Identity(), r_IB, w);
  AddRateOverLeverArm(P, Matrix3d::Identity(), r_IB, gyro_variance);
  return P.Dense();
}

}  // namespace reckon::estimator
