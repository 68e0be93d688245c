#pragma once

#include <Eigen/Core>

#include "reckon/estimator/error_state.h"
#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The error form of the classical multiplicative EKF: θ = Log(Rᵀ R̂) in I's axes, v̂ − v and p̂ − p
/// in W, ζ = b̂ − b. The mean, the noise and everything around it are those of the invariant filter:
/// the two differ in their error alone. Nothing here allocates.
class MultiplicativeEkf : public ErrorState<ErrorForm::kMultiplicative> {
 public:
  /// Propagates mean and covariance over one held sample, with the exact Jacobian of the step
  ///
  ///               θ         v     p         b_g              b_a
  ///     θ        Γ0ᵀ                     −Γ0ᵀ Γ1 Δt
  ///     v   −R [Γ1 a]× Δt   I         −R ∂(Γ1 a)/∂φ Δt²    −R Γ1 Δt
  ///     p   −R [Γ2 a]× Δt²  IΔt   I   −R ∂(Γ2 a)/∂φ Δt³    −R Γ2 Δt²
  ///
  /// and the noise of a sample that is held, which acts as a bias that lives one step.
  void Propagate(const Increment& u, const Eigen::Vector3d& g, const ProcessNoise& noise,
                 const RollingFeet* rolling = nullptr);

  /// The blocks of a measurement for this error: H_θ = (H_θr + H_v [v̂]× + H_p [p̂]×) R̂.
  template <int kRows>
  static Linearisation<kRows> Convert(const Linearisation<kRows>& m, const NavigationState& x) {
    return ForError(m, x, Eigen::Matrix3d::Identity());
  }

  /// R⁺ = R̂ Exp(θ), v⁺ = v̂ + δv, p⁺ = p̂ + δp and b⁺ = b̂ + ζ for the increment K z.
  void Retract(const SlotVector& increment);

  /// As RightInvariantEkf::BodyCovariance; here `w` turns orientation error into velocity error.
  ErrorCovariance BodyCovariance(const Eigen::Vector3d& r_IB, const Eigen::Vector3d& w,
                                 double gyro_variance) const;
};

}  // namespace reckon::estimator
