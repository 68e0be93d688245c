#pragma once

#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/prior.h"
#include "reckon/models/pose_sample.h"

namespace reckon::estimator {

/// A first state of I and the covariance of its right-invariant error.
struct FirstState {
  NavigationState x;
  ErrorCovariance P;
};

/// From a pose sample with orientation: R and p are the sensor's, velocity and biases the prior's.
/// With q̂ the sensor's origin, n_p its noise and θ that of its orientation (times `scale`),
///     ξ_p = n_p + [q̂]× θ,   ξ_v = n_v + [v̂]× θ.
/// `X_IS` is the sensor's frame in I. Does not allocate.
FirstState StateFromPose(const models::PoseSample& y, const models::Pose& X_IS, double scale,
                         const Prior& prior);

}  // namespace reckon::estimator
