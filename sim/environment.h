#pragma once

#include "reckon/models/time.h"
#include "reckon/sim/surroundings.h"

namespace reckon::sim {

/// What sensors may know of the world that they are in.
struct Environment {
  models::TimeNs step_ns = 1'000'000;  ///< between two motion windows
  double gravity_m_s2 = 9.81;
  double water_density_kg_m3 = 1025.0;
  double sound_speed_m_s = 1500.0;
  const Surroundings* surroundings = nullptr;  ///< null: nothing can be seen
};

}  // namespace reckon::sim
