#pragma once

#include <string>

#include "reckon/sim/mujoco_model.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/terrain.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// The geom that touches kerbs for the wheel of `joint`.
std::string WheelContactGeom(const std::string& joint);

/// Moves the two boxes that are the kerbs to where the kerbs around the robot lie.
void PlaceKerbs(const Terrain& terrain, double robot_x_m, mjData& data);

/// Compiles the simulated robot in its world: the URDF on a free joint, with the differences of
/// `config.actual` applied. Smooth ground has no geoms at all, since the tyre finds it by itself;
/// kerbs are boxes on a plane that spheres in the wheels touch without friction (condim 1); there
/// are two of them, which follow the robot, since it never reaches a third. Throws
/// std::invalid_argument, which names the file and the thing at fault.
ModelPtr BuildSkidSteerModel(const RobotConfig& robot, const WorldConfig& config,
                             const Terrain& terrain);

}  // namespace reckon::sim
