#pragma once

#include <Eigen/Core>

#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The height of a point that moves with the state, y = e_zᵀ q + n, n of standard deviation
/// `sigma_m`: q is a foot (`slot` is its slot) or a point of the body, q = p + R r (`slot` is the
/// position's). With q̂ its estimate in W, in right-invariant coordinates
///     z = y − e_zᵀ q̂,   H = (q̂_y, −q̂_x, 0) at θ and e_zᵀ at the slot.
/// Does not allocate.
Linearisation<1> LinearisedHeight(double y_m, double sigma_m, Slot slot, const Eigen::Vector3d& q);

}  // namespace reckon::estimator
