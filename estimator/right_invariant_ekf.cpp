#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Vector3d;

[[gnu::flatten]] void RightInvariantEkf::Propagate(const Increment& u, const Vector3d& g,
                                                   const ProcessNoise& noise) {
  const double dt = u.dt;
  const LaneMatrix R_dt = dt * ToLanes(x_.R);
  x_ = Propagated(x_, u, g);

  // Gravity and velocity; the position first, it reads the old velocity.
  const Lane g_dt = dt * ToLane(g), half_g_dt2 = 0.5 * dt * g_dt;
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, CrossProduct{half_g_dt2}, kThetaSlot);
  P_.AddRow(kVelocitySlot, CrossProduct{g_dt}, kThetaSlot);

  // Biases, and the noise of the sample.
  const Lane a = ToLane(u.a);
  const LaneMatrix theta_g = -(R_dt * u.G1);
  BiasColumns J;
  J.gyro[kThetaSlot] = theta_g;
  J.gyro[kVelocitySlot] =
      Cross(ToLane(x_.v), theta_g) - dt * (R_dt * u.series.GammaDerivative(1, a));
  J.gyro[kPositionSlot] =
      Cross(ToLane(x_.p), theta_g) - dt * dt * (R_dt * u.series.GammaDerivative(2, a));
  J.accel_velocity = theta_g;
  J.accel_position = -dt * (R_dt * u.G2);
  for (const Slot foot : P_.slots().feet()) J.gyro[foot] = Cross(ToLane(x_.At(foot)), theta_g);
  P_.AddBiases(J, noise, dt);
}

[[gnu::flatten]] void RightInvariantEkf::Retract(const SlotVector& increment) {
  const RotationSeries<3> theta(increment[kThetaSlot]);
  const LaneMatrix turn = theta.GammaInLanes(0);
  const LaneMatrix J = theta.GammaInLanes(1);
  Store(turn * ToLanes(x_.R), x_.R);
  P_.slots().Visit([&](const auto& slots) {
    slots.ForEachMoved([&](Slot slot) {
      if (slot == kThetaSlot) return;
      x_.At(slot) = ToEigen(turn * ToLane(x_.At(slot)) + J * increment[slot]);
    });
  });
  RetractBiases(increment);
}

ErrorCovariance RightInvariantEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& /*w*/,
                                                  double gyro_variance) const {
  // θ and the position keep their form.
  Covariance P = P_;
  AddRateOverLeverArm(P, x_.R, r_IB, gyro_variance);
  return P.Dense();
}

}  // namespace reckon::estimator
