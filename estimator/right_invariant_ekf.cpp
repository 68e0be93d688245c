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
  P_.AddRow(kPositionSlot, dt, kVelocitySlot);
  P_.AddRow(kPositionSlot, CrossProduct{half_g_dt2}, kThetaSlot);
  P_.AddRow(kVelocitySlot, CrossProduct{g_dt}, kThetaSlot);

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
  P_.AddBiases(J, noise, dt);
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
