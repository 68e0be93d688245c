#pragma once

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// Where a filter goes on after `gap_s` in which nobody saw what happened: at rest in its last
/// place, with the tilt that `up_I`, a mean specific force in I, gives, and the covariance of that
/// (right-invariant): any heading, 0.2 rad of tilt, 3 m/s, a place within 3 m/s times the gap.
/// `P` is the covariance of before; of it the biases stay, and walk. Does not allocate.
struct Reanchored {
  NavigationState x;
  ErrorCovariance P;
};
Reanchored Reanchor(const NavigationState& before, const ErrorCovariance& P,
                    const ProcessNoise& noise, const Eigen::Vector3d& up_I, double gap_s);

}  // namespace reckon::estimator
