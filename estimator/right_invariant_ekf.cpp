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

[[gnu::flatten]] void RightInvariantEkf::AddCurvature(const Vector3d& r, double samples,
                                                      Linearisation<1>& m) const {
  constexpr double kNegligible = 1e-4;  // of the variance
  const LaneMatrix& tt = P_(kThetaSlot, kThetaSlot);
  const LaneMatrix& tp = P_(kThetaSlot, kPositionSlot);
  const LaneMatrix& pp = P_(kPositionSlot, kPositionSlot);
  const Vector3d q = x_.p + x_.R * r;
  const double tilt = tt(0, 0) + tt(1, 1), turn = tilt + tt(2, 2);
  const double most = 2.0 * (pp(0, 0) + pp(1, 1) + q.squaredNorm() * turn);
  if (samples * tilt * most < kNegligible * m.N(0)) return;
  // δ = ξ_p − [q]× θ.
  const Eigen::Matrix3d T = ToEigen(tt), q_cross = Skew(q);
  const Eigen::Matrix3d td = ToEigen(tp) + T * q_cross;  // of θ and δ
  const Eigen::Matrix3d dd = ToEigen(pp) - q_cross * ToEigen(tp) + td.transpose() * q_cross;
  // Isserlis: of products of Gaussian factors. The mean stays in the innovation: a start that is
  // exact would be moved by it.
  const double mean = td(0, 1) - td(1, 0);
  const double x_y = T(0, 0) * dd(1, 1) + td(0, 1) * td(0, 1);
  const double y_x = T(1, 1) * dd(0, 0) + td(1, 0) * td(1, 0);
  const double both = T(0, 1) * dd(1, 0) + td(0, 0) * td(1, 1);
  const double square = 0.25 * (x_y + y_x - 2.0 * both + mean * mean);
  m.N(0) += square;
  m.lasting = (samples - 1.0) * square;
}

void RightInvariantEkf::Retract(const SlotVector& increment) {
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
