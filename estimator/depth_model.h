#pragma once

#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/depth_sample.h"

namespace reckon::estimator {

/// A depth sensor at `r` in I: −y = e_zᵀ (p + R r) + n, n of standard deviation `sigma_m`. It is a
/// left-invariant measurement whose row is moved instead of the covariance (LinearisedHeight).
/// Does not allocate.
Linearisation<1> LinearisedDepth(const models::DepthSample& y, const Eigen::Vector3d& r,
                                 double sigma_m, const NavigationState& x);

}  // namespace reckon::estimator
