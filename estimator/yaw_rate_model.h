#pragma once

#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// A yaw rate y = e_zᵀ ω + n of the body from elsewhere than the gyroscope, whose reading (with the
/// bias in it) is `w_z`, of noise n_w: y = w_z − e_zᵀ b_g − n_w + n, so that
///     z = y − (w_z − e_zᵀ b̂_g),   H = −e_zᵀ at b_g,   N the variance of n − n_w.
/// Does not allocate.
Linearisation<1> LinearisedYawRate(double y_rad_s, double w_z, double variance,
                                   const NavigationState& x);

}  // namespace reckon::estimator
