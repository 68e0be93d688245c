#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {

using Eigen::Vector3d;

[[gnu::flatten]] void RightInvariantEkf::Propagate(const Increment& u, const Vector3d& g,
                                                   const ProcessNoise& noise,
                                                   const RollingFeet* rolling) {
  const double dt = u.dt;
  const LaneMatrix R = ToLanes(x_.R), R_dt = dt * R;
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
  for (const Slot foot : P_.slots().feet()) {
    if (rolling == nullptr) {
      J.gyro[foot] = Cross(ToLane(x_.At(foot)), theta_g);
      continue;
    }
    const RollingFeet::Step step = rolling->Over(u, foot);
    x_.At(foot) = ToEigen(ToLane(x_.At(foot)) + R * step.moved);
    J.gyro[foot] = Cross(ToLane(x_.At(foot)), theta_g) + R * step.by_bias;
  }
  P_.AddBiases(J, noise, dt);
}

void RightInvariantEkf::AddCurvature(const Vector3d& r, double samples, Linearisation<1>& m) const {
  constexpr double kNegligible = 1e-4;  // of the variance
  const LaneMatrix& T = P_(kThetaSlot, kThetaSlot);
  const LaneMatrix& C = P_(kThetaSlot, kPositionSlot);
  const LaneMatrix& D = P_(kPositionSlot, kPositionSlot);
  const Vector3d q = x_.p + x_.R * r;
  const double tilt = T(0, 0) + T(1, 1);
  const double most = 2.0 * (D(0, 0) + D(1, 1) + q.squaredNorm() * (tilt + T(2, 2)));
  if (samples * tilt * most < kNegligible * m.N(0)) return;
  // Covariances with δ = ξ_p − [q]× θ: of θ, C + T [q]×, by columns x and y; of δ itself.
  const auto with_x = [&](int i) { return C(i, 0) + T(i, 1) * q.z() - T(i, 2) * q.y(); };
  const auto with_y = [&](int i) { return C(i, 1) - T(i, 0) * q.z() + T(i, 2) * q.x(); };
  const double xx = with_x(0), yx = with_x(1), zx = with_x(2);
  const double xy = with_y(0), yy = with_y(1), zy = with_y(2);
  const double dxx = D(0, 0) + q.z() * (C(1, 0) + yx) - q.y() * (C(2, 0) + zx);
  const double dyy = D(1, 1) - q.z() * (C(0, 1) + xy) + q.x() * (C(2, 1) + zy);
  const double dxy = D(0, 1) + q.z() * (C(1, 1) - xx) - q.y() * C(2, 1) + q.x() * zx;
  // Isserlis: E[(θ_x δ_y − θ_y δ_x)²] of Gaussian factors. Its mean stays in the innovation: a
  // start that is exact would be moved by it.
  const double mean = xy - yx;
  const double square = 0.25 * (T(0, 0) * dyy + xy * xy + T(1, 1) * dxx + yx * yx -
                                2.0 * (T(0, 1) * dxy + xx * yy) + mean * mean);
  m.N(0) += square;
  m.lasting = (samples - 1.0) * square;
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
