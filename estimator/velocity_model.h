#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/body_velocity_sample.h"
#include "reckon/models/pose.h"

namespace reckon::estimator {

/// What a velocity correction needs of the IMU: the turn rate of the body, less the bias, and the
/// variance of one axis of that sample.
struct TurnRate {
  Eigen::Vector3d w_rad_s = Eigen::Vector3d::Zero();
  double variance = 0.0;
};

/// A velocity over ground at a frame S of the body, y = R_SI (Rᵀ v + ω × r) + n with r = p_IS, in
/// right-invariant coordinates:
///     z = R̂ (R_IS y − ω̂ × r) − v̂,   H = I at v and R̂ [r]× at b_g,
///     N = R̂ (R_IS N_S R_ISᵀ + σ_ω² [r]× [r]×ᵀ) R̂ᵀ.
/// `X_IS` is the sensor's frame in I; without a lever arm no bias is seen. Does not allocate.
Linearisation<3> LinearisedVelocity(const models::BodyVelocitySample& y, const models::Pose& X_IS,
                                    const TurnRate& turn, const NavigationState& x);

}  // namespace reckon::estimator
