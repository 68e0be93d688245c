#pragma once

#include <vector>

#include "reckon/sim/autopilot.h"
#include "reckon/sim/hydrodynamics.h"
#include "reckon/sim/thrusters.h"

namespace reckon::sim {

/// An underwater vehicle as the simulator builds it: what the URDF can't say.
struct UnderwaterConfig {
  HydrodynamicsConfig hydrodynamics;
  std::vector<ThrusterConfig> thrusters;
  AutopilotConfig autopilot;
};

}  // namespace reckon::sim
