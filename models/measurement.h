#pragma once

#include <cstdint>
#include <variant>

#include "reckon/models/body_velocity_sample.h"
#include "reckon/models/contact_sample.h"
#include "reckon/models/depth_sample.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/foot_force_sample.h"
#include "reckon/models/imu_sample.h"
#include "reckon/models/pose_sample.h"
#include "reckon/models/time.h"
#include "reckon/models/torque_sample.h"

namespace reckon::models {

/// The place of a sensor in its robot's suite (`Suite::sensors`).
using SensorId = std::uint16_t;

/// Everything that a robot's hardware can send. The variant is closed: truth is not one of its
/// types.
using Sample = std::variant<ImuSample, EncoderSample, BodyVelocitySample, DepthSample, PoseSample,
                            ContactSample, TorqueSample, FootForceSample>;

/// One message of one sensor: the only thing that an estimator is ever given.
struct Measurement {
  SensorId sensor = 0;
  TimeNs valid_ns = 0;  ///< when the sample was true (the end of its interval, if it has one)
  TimeNs arrival_ns =
      0;  ///< when it reaches the estimator; not before `valid_ns` on honest hardware
  Sample sample;
};

}  // namespace reckon::models
