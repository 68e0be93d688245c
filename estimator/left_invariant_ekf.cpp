#include "reckon/estimator/left_invariant_ekf.h"

#include "reckon/estimator/error_form.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void LeftInvariantEkf::Start(const NavigationState& x, const ErrorCovariance& P_right_invariant) {
  x_ = x;
  P_.Start(ConvertForm(P_right_invariant, ErrorForm::kRightInvariant, kForm, x));
}

void LeftInvariantEkf::Propagate(const Increment& u, const Vector3d& g, const ProcessNoise& noise) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  x_ = Propagated(x_, u, g);

  // In the axes of before the step: position first, it reads the old velocity. Then all turn.
  const Lane dv = ToLane(-dt * (u.G1 * u.a)), dp = ToLane(-dt2 * (u.G2 * u.a));
  P_.AddRow(
      kPositionSlot, [dt](const LaneMatrix& v) { return dt * v; }, kVelocitySlot);
  P_.AddRow(
      kPositionSlot, [dp](const LaneMatrix& theta) { return Cross(dp, theta); }, kThetaSlot);
  P_.AddRow(
      kVelocitySlot, [dv](const LaneMatrix& theta) { return Cross(dv, theta); }, kThetaSlot);
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
  for (const Slot slot : P_.active()) {
    if (IsFoot(slot)) J.gyro[slot] = LaneMatrix::Zero();
  }
  P_.AddBiases(J, noise.gyro / (2.0 * dt), noise.accel / (2.0 * dt));
  P_.AddDiagonal(kGyroBiasSlot, noise.gyro_walk * dt);
  P_.AddDiagonal(kAccelBiasSlot, noise.accel_walk * dt);
}

void LeftInvariantEkf::Retract(const SlotVector& increment) {
  const RotationSeries theta(ToEigen(increment[kThetaSlot]));
  const Matrix3d RJ = x_.R * theta.Gamma(1);
  for (const Slot slot : P_.active()) {
    if (slot == kThetaSlot || slot >= kGyroBiasSlot) continue;
    x_.At(slot) += RJ * ToEigen(increment[slot]);
  }
  x_.R = x_.R * theta.Gamma(0);
  x_.gyro_bias += ToEigen(increment[kGyroBiasSlot]);
  x_.accel_bias += ToEigen(increment[kAccelBiasSlot]);
}

ErrorCovariance LeftInvariantEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& w,
                                                 double gyro_variance) const {
  // p_B = p + R r and v_B = v + R (w × r), all in I's axes.
  const Matrix3d A = Skew(r_IB);
  ErrorCovariance T = ErrorCovariance::Identity();
  T.block<3, 3>(kPosition, kTheta) = -A;
  T.block<3, 3>(kVelocity, kTheta) = -Skew(w.cross(r_IB));
  T.block<3, 3>(kVelocity, kGyroBias) = A;
  ErrorCovariance P = T * P_.Dense() * T.transpose();
  P.block<3, 3>(kVelocity, kVelocity) += gyro_variance * A * A.transpose();
  return P;
}

}  // namespace reckon::estimator
