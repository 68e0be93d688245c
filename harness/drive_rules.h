#pragma once

#include <string>

#include "reckon/harness/rule_book.h"
#include "reckon/harness/scenario.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::harness {

/// The rules about what moves the robot, the world that it moves in and where it goes.
void CheckDriven(const Scenario& scenario, const models::UrdfRobot& urdf,
                 const std::string& base_link, const RuleBook& book);

}  // namespace reckon::harness
