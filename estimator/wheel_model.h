#pragma once

#include <optional>

#include "reckon/estimator/setup.h"
#include "reckon/models/body_velocity_sample.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/suite.h"

namespace reckon::estimator {

/// Mean wheel rates of the two sides [rad/s].
struct SideRates {
  double left = 0.0, right = 0.0;
};

/// The sides' mean rates; nothing if the sample has no entry for one of the drive's wheels.
std::optional<SideRates> MeanRates(const models::EncoderSample& sample,
                                   const models::WheelDrive& drive);

/// What wheels say of the body's velocity in the drive's frame: y_x = ρ (ω_left + ω_right)/2, and
/// the nonholonomic y_y = y_z = 0, each row with its own variance. Does not allocate.
models::BodyVelocitySample WheelVelocity(const SideRates& rates, const models::WheelDrive& drive,
                                         const Noise& noise);

/// What wheels say of the yaw rate: ρ (ω_right − ω_left)/track, with the track that slip leaves.
double WheelYawRate(const SideRates& rates, const models::WheelDrive& drive);

}  // namespace reckon::estimator
