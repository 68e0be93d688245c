#pragma once

#include <Eigen/Core>

#include "reckon/models/time.h"

namespace reckon::models {

/// The most joints or wheels that one encoder message can hold (bounded: no step allocates).
inline constexpr int kMaxEncoders = 16;

using EncoderVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxEncoders, 1>;

/// What a set of rotary encoders (wheels or joints) reports: one entry an encoder, in the order of
/// the sensor's description.
///
/// `angle_rad` is the accumulated, quantised angle at the time of validity; `rate_rad_s` is its
/// mean rate over (t − interval, t], as the firmware computes it from counts.
struct EncoderSample {
  EncoderVector angle_rad;
  EncoderVector rate_rad_s;
  TimeNs interval_ns = 0;
};

}  // namespace reckon::models
