#pragma once

#include <string>

#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// The scenario with every value written out: resolved.yaml. Reading it gives the same scenario,
/// and writing that the same bytes, whatever the robot's own defaults are by then.
std::string WriteScenario(const Scenario& scenario);

}  // namespace reckon::harness
