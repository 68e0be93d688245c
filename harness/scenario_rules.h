#pragma once

#include <string>

#include "reckon/harness/scenario.h"
#include "reckon/harness/yaml_node.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::harness {

/// Checks what no single key can say: names that must exist, rates that must divide the physics
/// rate, times in order. What the simulator would refuse of a scenario is refused here, at its
/// line. `base_link` is the link of `urdf` that carries the wheels. `root` is what `scenario` was
/// read from: it tells where each value was written.
void CheckScenario(const Scenario& scenario, const models::UrdfRobot& urdf,
                   const std::string& base_link, const YamlNode& root, Problems& problems);

/// The same for a scenario with a log in place of a robot and a world.
void CheckLogScenario(const Scenario& scenario, const YamlNode& root, Problems& problems);

}  // namespace reckon::harness
