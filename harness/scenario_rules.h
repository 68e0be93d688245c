#pragma once

#include "reckon/harness/scenario.h"
#include "reckon/harness/yaml_node.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::harness {

/// Checks what no single key can say: names that must exist, rates that must divide the physics
/// rate, times in order. `root` is what `scenario` was read from: it tells where each value was
/// written.
void CheckScenario(const Scenario& scenario, const models::UrdfRobot& urdf, const YamlNode& root,
                   Problems& problems);

}  // namespace reckon::harness
