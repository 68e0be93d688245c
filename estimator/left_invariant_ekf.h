#pragma once

#include <Eigen/Core>

#include "reckon/estimator/error_state.h"
#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The error form of the left-invariant EKF [Hartley20]: η = X⁻¹ X̂ = exp(ξ), ζ = b̂ − b. It holds
/// the error in I's axes. Nothing here allocates.
class LeftInvariantEkf : public ErrorState<ErrorForm::kLeftInvariant> {
 public:
  /// Propagates mean and covariance over one held sample, with the exact Φ of the error,
  /// Ad_X̂⁺⁻¹ Φ_r Ad_X̂:
  ///
  ///              θ           v      p         b_g                b_a
  ///     θ       Γ0ᵀ                        −Γ0ᵀ Γ1 Δt
  ///     v   −Γ0ᵀ[Γ1 a]×Δt   Γ0ᵀ            −Γ0ᵀ ∂(Γ1 a)/∂φ Δt²   −Γ0ᵀ Γ1 Δt
  ///     p   −Γ0ᵀ[Γ2 a]×Δt²  Γ0ᵀΔt  Γ0ᵀ     −Γ0ᵀ ∂(Γ2 a)/∂φ Δt³   −Γ0ᵀ Γ2 Δt²
  ///
  /// Γ0ᵀ for a foot, and the noise of a sample that is held.
  void Propagate(const Increment& u, const Eigen::Vector3d& g, const ProcessNoise& noise,
                 const RollingFeet* rolling = nullptr);

  /// The blocks of a measurement for this error, H_l = H_r Ad_X̂.
  template <int kRows>
  static Linearisation<kRows> Convert(const Linearisation<kRows>& m, const NavigationState& x) {
    return ForError(m, x, x.R);
  }

  /// X⁺ = X̂ exp(ξ) and b⁺ = b̂ + ζ for the increment K z.
  void Retract(const SlotVector& increment);

  /// As RightInvariantEkf::BodyCovariance; here a turn moves the body's origin, which lies off I's.
  ErrorCovariance BodyCovariance(const Eigen::Vector3d& r_IB, const Eigen::Vector3d& w,
                                 double gyro_variance) const;
};

}  // namespace reckon::estimator
