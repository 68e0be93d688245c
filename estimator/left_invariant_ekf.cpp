#include "reckon/estimator/left_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

[[gnu::flatten]] void LeftInvariantEkf::Propagate(const Increment& u, const Vector3d& g,
                                                  const ProcessNoise& noise,
                                                  const RollingFeet* rolling) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  const Lane a = ToLane(u.a);
  const LaneMatrix R = ToLanes(x_.R);
  x_ = Propagated(x_, u, g);

  // In the axes of before the step: position first, it reads the old velocity. Then all turn.
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, CrossProduct{-dt2 * (u.G2 * a)}, kThetaSlot);
  P_.AddRow(kVelocitySlot, CrossProduct{-dt * (u.G1 * a)}, kThetaSlot);
  BiasColumns J;
  const LaneMatrix turn = Transposed(u.G0);
  if (rolling != nullptr) {
    for (const Slot foot : P_.slots().feet()) {
      const RollingFeet::Step step = rolling->Over(u, foot);
      x_.At(foot) = ToEigen(ToLane(x_.At(foot)) + R * step.moved);
      P_.AddRow(foot, CrossProduct{-step.moved}, kThetaSlot);
      J.gyro[foot] = turn * step.by_bias;
    }
  }
  P_.slots().loops().ForEachMoved([&](Slot slot) { P_.MapRow(slot, turn); });

  J.gyro[kThetaSlot] = -dt * (turn * u.G1);
  J.gyro[kVelocitySlot] = -dt2 * (turn * u.series.GammaDerivative(1, a));
  J.gyro[kPositionSlot] = -dt2 * dt * (turn * u.series.GammaDerivative(2, a));
  J.accel_velocity = J.gyro[kThetaSlot];
  J.accel_position = -dt2 * (turn * u.G2);
  P_.AddBiases(J, noise, dt);
}

[[gnu::flatten]] void LeftInvariantEkf::Retract(const SlotVector& increment) {
  const RotationSeries<3> theta(increment[kThetaSlot]);
  const LaneMatrix R = ToLanes(x_.R);
  const LaneMatrix RJ = R * theta.GammaInLanes(1);
  P_.slots().loops().ForEachMoved([&](Slot slot) {
    if (slot != kThetaSlot) x_.At(slot) = ToEigen(ToLane(x_.At(slot)) + RJ * increment[slot]);
  });
  Store(R * theta.GammaInLanes(0), x_.R);
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
