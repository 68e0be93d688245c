#pragma once

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// The linear map from error coordinates `from` to `to` at the estimate x̂, ε_to = T ε_from:
///     right to left            T = blkdiag(Ad_X̂⁻¹, I):  θ_l = R̂ᵀθ, ξ_vl = R̂ᵀ(ξ_v − [v̂]×θ)
///     right to multiplicative  θ_m = R̂ᵀθ, δv = ξ_v − [v̂]×θ, positions likewise,
/// and their inverses and products. Between the invariant forms it holds for errors of any size
/// (as Log X̂X⁻¹ = Ad_X Log X⁻¹X̂, with either state); to the multiplicative form to first order.
ErrorCovariance FormMap(ErrorForm from, ErrorForm to, const NavigationState& x);

/// T P Tᵀ.
ErrorCovariance ConvertForm(const ErrorCovariance& P, ErrorForm from, ErrorForm to,
                            const NavigationState& x);

/// The error of `hat` against `x` in the coordinates of `form`, as `ErrorForm` defines them.
ErrorVector ErrorBetween(ErrorForm form, const NavigationState& hat, const NavigationState& x);

}  // namespace reckon::estimator
