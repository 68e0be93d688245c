#pragma once

#include <Eigen/Core>

#include "reckon/estimator/error_state.h"
#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The error form of the right-invariant EKF [Hartley20]: η = X̂ X⁻¹ = exp(ξ), ζ = b̂ − b.
///
/// A covariance is never moved to another state: after a correction it stays in the frame of the
/// prior estimate. Nothing here allocates.
class RightInvariantEkf : public ErrorState<ErrorForm::kRightInvariant> {
 public:
  /// Propagates mean and covariance over one held sample, with the exact Φ of the error
  ///
  ///            θ        v     p     b_g    b_a
  ///     θ      I                    θ_g
  ///     v   [g]×Δt      I           v_g    θ_g
  ///     p  ½[g]×Δt²    IΔt    I     p_g    p_a
  ///
  /// and d_g = [d]× θ_g for a foot (of a rolling one, d⁺ = d + R Γ1 u Δt,
  /// d_g = [d⁺]× θ_g + R Γ1 [l]× Δt − R ∂(Γ1 u)/∂φ Δt²), θ_g = −R Γ1 Δt, v_g = [v⁺]× θ_g − R ∂(Γ1
  /// a)/∂φ Δt², p_g = [p⁺]× θ_g − R ∂(Γ2 a)/∂φ Δt³, p_a = −R Γ2 Δt², and the exact noise of a
  /// sample that is held: it acts as a bias that lives one step, J (Q/Δt) Jᵀ, beside the walk.
  void Propagate(const Increment& u, const Eigen::Vector3d& g, const ProcessNoise& noise,
                 const RollingFeet* rolling = nullptr);

  /// The blocks of a measurement in this form's coordinates: as they are.
  template <int kRows>
  static const Linearisation<kRows>& Convert(const Linearisation<kRows>& m,
                                             const NavigationState& /*x*/) {
    return m;
  }

  /// What a height of the point q = p + R r leaves out when it is linearised. An error (θ, ξ_p)
  /// moves the point by δ = ξ_p + θ × q, and its height to second order by
  ///     c = ½ e_zᵀ (θ × δ)
  /// beside −e_zᵀ δ: exp(−θ) q − J(−θ) ξ_p, expanded. Its mean square under P, that of products of
  /// Gaussians, is added to the noise of `m`, and to what lasts as often as there are further
  /// `samples` over which c is one and the same error: as white noise it would be averaged away.
  /// This counts where tilt and position are uncertain, as they are after half a minute without a
  /// velocity; then the filter is over-confident without it. `m` stays as it is where that is
  /// surely below a hundredth of its noise. Does not allocate.
  void AddCurvature(const Eigen::Vector3d& r, double samples, Linearisation<1>& m) const;

  /// X⁺ = exp(ξ) X̂ and b⁺ = b̂ + ζ for the increment K z.
  void Retract(const SlotVector& increment);

  /// The covariance of the body's error: B's origin lies at `r_IB` in I, and v_B = v + R(ω × r_IB)
  /// with a gyroscope sample of variance `gyro_variance`.
  ErrorCovariance BodyCovariance(const Eigen::Vector3d& r_IB, const Eigen::Vector3d& w,
                                 double gyro_variance) const;
};

}  // namespace reckon::estimator
