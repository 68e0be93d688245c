#pragma once

#include "reckon/models/contact_sample.h"

namespace reckon::models {

/// What sensors in the feet weigh: the force that presses each foot, along the ground's normal, in
/// the order of the robot's legs [N].
struct FootForceSample {
  FootVector force_n;
};

}  // namespace reckon::models
