#include "reckon/estimator/multiplicative_ekf.h"

#include "reckon/estimator/error_form.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void MultiplicativeEkf::Start(const NavigationState& x, const ErrorCovariance& P_right_invariant) {
  x_ = x;
  P_.Start(ConvertForm(P_right_invariant, ErrorForm::kRightInvariant, kForm, x));
}

void MultiplicativeEkf::Propagate(const Increment& u, const Vector3d& g,
                                  const ProcessNoise& noise) {
  const double dt = u.dt;
  const double dt2 = dt * dt;
  const Matrix3d R = x_.R;
  x_ = Propagated(x_, u, g);

  // Position first, it reads the old velocity; orientation last, all read the old one.
  const LaneMatrix turn = ToLanes(u.G0.transpose());
  const auto times = [](const Matrix3d& M) {
    return [M = ToLanes(M)](const LaneMatrix& X) { return M * X; };
  };
  P_.AddRow(
      kPositionSlot, [dt](const LaneMatrix& v) { return dt * v; }, kVelocitySlot);
  P_.AddRow(kPositionSlot, times(-dt2 * R * Skew(u.G2 * u.a)), kThetaSlot);
  P_.AddRow(kVelocitySlot, times(-dt * R * Skew(u.G1 * u.a)), kThetaSlot);
  P_.MapRow(kThetaSlot, turn);

  BiasColumns J;
  J.gyro[kThetaSlot] = ToLanes(-dt * u.G0.transpose() * u.G1);
  J.gyro[kVelocitySlot] = ToLanes(-dt2 * R * u.series.GammaDerivative(1, u.a));
  J.gyro[kPositionSlot] = ToLanes(-dt2 * dt * R * u.series.GammaDerivative(2, u.a));
  J.accel_velocity = ToLanes(-dt * R * u.G1);
  J.accel_position = ToLanes(-dt2 * R * u.G2);
  for (const Slot slot : P_.active()) {
    if (IsFoot(slot)) J.gyro[slot] = LaneMatrix::Zero();
  }
  P_.AddBiases(J, noise.gyro / (2.0 * dt), noise.accel / (2.0 * dt));
  P_.AddDiagonal(kGyroBiasSlot, noise.gyro_walk * dt);
  P_.AddDiagonal(kAccelBiasSlot, noise.accel_walk * dt);
}

void MultiplicativeEkf::Retract(const SlotVector& increment) {
  x_.R = x_.R * Exp(ToEigen(increment[kThetaSlot]));
  for (const Slot slot : P_.active()) {
    if (slot == kThetaSlot || slot >= kGyroBiasSlot) continue;
    x_.At(slot) += ToEigen(increment[slot]);
  }
  x_.gyro_bias += ToEigen(increment[kGyroBiasSlot]);
  x_.accel_bias += ToEigen(increment[kAccelBiasSlot]);
}

ErrorCovariance MultiplicativeEkf::BodyCovariance(const Vector3d& r_IB, const Vector3d& w,
                                                  double gyro_variance) const {
  const Matrix3d A = x_.R * Skew(r_IB);
  ErrorCovariance T = ErrorCovariance::Identity();
  T.block<3, 3>(kPosition, kTheta) = -A;
  T.block<3, 3>(kVelocity, kTheta) = -x_.R * Skew(w.cross(r_IB));
  T.block<3, 3>(kVelocity, kGyroBias) = A;
  ErrorCovariance P = T * P_.Dense() * T.transpose();
  P.block<3, 3>(kVelocity, kVelocity) += gyro_variance * A * A.transpose();
  return P;
}

}  // namespace reckon::estimator
