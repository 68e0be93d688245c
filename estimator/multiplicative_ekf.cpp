#include "reckon/estimator/multiplicative_ekf.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void MultiplicativeEkf::Propagate(const Increment& u, const Vector3d& g,
                                  const ProcessNoise& noise) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  const Matrix3d R = x_.R;
  x_ = Propagated(x_, u, g);

  // Position first, it reads the old velocity; orientation last, all read the old one.
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, ToLanes(-dt2 * R * Skew(u.G2 * u.a)), kThetaSlot);
  P_.AddRow(kVelocitySlot, ToLanes(-dt * R * Skew(u.G1 * u.a)), kThetaSlot);
  P_.MapRow(kThetaSlot, ToLanes(u.G0.transpose()));

  BiasColumns J;
  J.gyro[kThetaSlot] = ToLanes(-dt * u.G0.transpose() * u.G1);
  J.gyro[kVelocitySlot] = ToLanes(-dt2 * R * u.series.GammaDerivative(1, u.a));
  J.gyro[kPositionSlot] = ToLanes(-dt2 * dt * R * u.series.GammaDerivative(2, u.a));
  J.accel_velocity = ToLanes(-dt * R * u.G1);
  J.accel_position = ToLanes(-dt2 * R * u.G2);
  P_.AddBiases(J, noise, dt);
}

void MultiplicativeEkf::Retract(const SlotVector& increment) {
  x_.R = x_.R * Exp(ToEigen(increment[kThetaSlot]));
  for (const Slot slot : P_.active()) {
    if (slot == kThetaSlot || slot >= kGyroBiasSlot) continue;
    x_.At(slot) += ToEigen(increment[slot]);
  }
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
