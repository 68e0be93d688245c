#pragma once

#include <Eigen/Core>

#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// Zero velocity: 0 = v + n of standard deviation `sigma_m_s` an axis: z = −v̂, H = I at v. Does not
/// allocate.
Linearisation<3> LinearisedZeroVelocity(double sigma_m_s, const NavigationState& x);

/// Zero angular rate: a gyroscope that does not turn reads its bias. `w` is its mean over a rest,
/// in I, and `variance` that of one axis of it: z = w − b̂_g, H = I at b_g. Does not allocate.
Linearisation<3> LinearisedZeroRate(const Eigen::Vector3d& w, double variance,
                                    const NavigationState& x);

}  // namespace reckon::estimator
