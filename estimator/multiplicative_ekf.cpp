#include "reckon/estimator/multiplicative_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

[[gnu::flatten]] void MultiplicativeEkf::Propagate(const Increment& u, const Vector3d& g,
                                                   const ProcessNoise& noise,
                                                   const RollingFeet* rolling) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  const Lane a = ToLane(u.a);
  const LaneMatrix R = ToLanes(x_.R);
  x_ = Propagated(x_, u, g);

  // Position first, it reads the old velocity; orientation last, all read the old one.
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, -dt2 * (R * DiagonalAndCross(0.0, u.G2 * a)), kThetaSlot);
  P_.AddRow(kVelocitySlot, -dt * (R * DiagonalAndCross(0.0, u.G1 * a)), kThetaSlot);
  BiasColumns J;
  if (rolling != nullptr) {
    for (const Slot foot : P_.slots().feet()) {
      const RollingFeet::Step step = rolling->Over(u, foot);
      x_.At(foot) = ToEigen(ToLane(x_.At(foot)) + R * step.moved);
      P_.AddRow(foot, -1.0 * (R * DiagonalAndCross(0.0, step.moved)), kThetaSlot);
      J.gyro[foot] = R * step.by_bias;
    }
  }
  P_.MapRow(kThetaSlot, Transposed(u.G0));

  J.gyro[kThetaSlot] = -dt * (Transposed(u.G0) * u.G1);
  J.gyro[kVelocitySlot] = -dt2 * (R * u.series.GammaDerivative(1, a));
  J.gyro[kPositionSlot] = -dt2 * dt * (R * u.series.GammaDerivative(2, a));
  J.accel_velocity = -dt * (R * u.G1);
  J.accel_position = -dt2 * (R * u.G2);
  P_.AddBiases(J, noise, dt);
}

[[gnu::flatten]] void MultiplicativeEkf::Retract(const SlotVector& increment) {
  Store(ToLanes(x_.R) * RotationSeries<3>(increment[kThetaSlot]).GammaInLanes(0), x_.R);
  P_.slots().loops().ForEachMoved([&](Slot slot) {
    if (slot != kThetaSlot) x_.At(slot) = ToEigen(ToLane(x_.At(slot)) + increment[slot]);
  });
  RetractBiases(increment);
}

ErrorCovariance MultiplicativeEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& w,
                                                  double gyro_variance) const {
  Covariance P = P_;
  AddTurnOfLeverArm(P, x_.R, r_IB, w);
  AddRateOverLeverArm(P, x_.R, r_IB, gyro_variance);
  return P.Dense();
}

}  // namespace reckon::estimator
