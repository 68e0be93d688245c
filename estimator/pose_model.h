#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/pose.h"
#include "reckon/models/pose_sample.h"

namespace reckon::estimator {

/// The position of a sensor's frame, y = p + R r + n with r = p_IS; with q̂ = p̂ + R̂ r
///     z = y − q̂,   H = −[q̂]× at θ and I at p,
/// in right-invariant coordinates. `scale` multiplies the sigma that is delivered. Does not
/// allocate.
Linearisation<3> LinearisedPosition(const models::PoseSample& y, const models::Pose& X_IS,
                                    double scale, const NavigationState& x);

/// The heading of a sensor's frame: the direction ψ = atan2(s_y, s_x) of its x axis s = R R_IS e_x
/// over ground. It says nothing of roll and pitch, as gravity does that better:
///     z = ψ(y) − ψ̂ in (−π, π],   H = (−s_z s_x/ρ², −s_z s_y/ρ², 1) at θ,   ρ² = s_x² + s_y².
/// Nothing if either axis points within 10° of the vertical or the sample has no orientation. Does
/// not allocate.
std::optional<Linearisation<1>> LinearisedYaw(const models::PoseSample& y, const models::Pose& X_IS,
                                              double scale, const NavigationState& x);

}  // namespace reckon::estimator
