#pragma once

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/legged_body.h"
#include "reckon/sim/mujoco_model.h"
#include "reckon/sim/terrain.h"

namespace reckon::sim {

/// Builds a robot on legs on its ground, of which `body` has been made: `config.actual` applied, a
/// sphere on every foot, motors' inertia and friction in every joint, contacts with the ground but
/// none of the robot with itself. Throws std::invalid_argument, which names the thing at fault.
ModelPtr BuildLeggedModel(const RobotConfig& robot, const WorldConfig& config,
                          const models::UrdfRobot& urdf, const LeggedBody& body,
                          const Terrain& terrain, std::uint64_t seed);

}  // namespace reckon::sim
