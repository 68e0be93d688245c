#pragma once

#include "reckon/models/encoder_sample.h"

namespace reckon::models {

/// The torques of a set of joints' motors, one entry a joint, in the order of the joints' encoders:
/// behind the gear, positive as the joint's angle is [N m].
struct TorqueSample {
  EncoderVector torque_n_m;
};

}  // namespace reckon::models
