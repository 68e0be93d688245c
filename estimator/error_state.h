#pragma once

#include <Eigen/Core>

#include "reckon/estimator/covariance.h"
#include "reckon/estimator/error_form.h"
#include "reckon/estimator/kalman.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// The mean of a filter and the covariance of its error, with what every error form does alike.
/// Nothing here allocates.
template <ErrorForm form>
class ErrorState {
 public:
  static constexpr ErrorForm kForm = form;

  /// Starts from a right-invariant covariance, moved to this form (`ConvertForm`).
  void Start(const NavigationState& x, const ErrorCovariance& P_right_invariant) {
    x_ = x;
    P_.Start(ConvertForm(P_right_invariant, ErrorForm::kRightInvariant, form, x));
  }

  const NavigationState& x() const { return x_; }
  NavigationState& x() { return x_; }
  const Covariance& P() const { return P_; }
  Covariance& P() { return P_; }

  /// What a height leaves out when it is linearised: forms in which that is another matter leave it
  /// be.
  static void AddCurvature(const Eigen::Vector3d& /*r*/, double /*samples*/,
                           const Linearisation<1>& /*m*/) {}

 protected:
  /// b⁺ = b̂ + ζ.
  void RetractBiases(const SlotVector& increment) {
    x_.gyro_bias = ToEigen(ToLane(x_.gyro_bias) + increment[kGyroBiasSlot]);
    x_.accel_bias = ToEigen(ToLane(x_.accel_bias) + increment[kAccelBiasSlot]);
  }

  NavigationState x_;
  Covariance P_;
};

/// What the rate over a lever arm adds to the error of v_B = v + R (ω × r): F [r]× ζ_g and a
/// gyroscope sample of variance `gyro_variance`. `F` takes I's axes to those of the error.
inline void AddRateOverLeverArm(Covariance& P, const Eigen::Matrix3d& F, const Eigen::Vector3d& r,
                                double gyro_variance) {
  const LaneMatrix A = ToLanes(F * Skew(r));
  P.AddRow(kVelocitySlot, A, kGyroBiasSlot);
  P(kVelocitySlot, kVelocitySlot) += gyro_variance * TimesTransposed(A, A);
}

/// What a turn θ in I's axes adds to the errors of p_B = p + R r and v_B = v + R (ω × r):
/// −F [r]× θ and −F [ω × r]× θ.
inline void AddTurnOfLeverArm(Covariance& P, const Eigen::Matrix3d& F, const Eigen::Vector3d& r,
                              const Eigen::Vector3d& w) {
  P.AddRow(kPositionSlot, ToLanes(-F * Skew(r)), kThetaSlot);
  P.AddRow(kVelocitySlot, ToLanes(-F * Skew(w.cross(r))), kThetaSlot);
}

}  // namespace reckon::estimator
