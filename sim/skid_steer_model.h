#pragma once

#include <memory>
#include <string>

#include <mujoco/mujoco.h>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/terrain.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

struct MujocoDelete {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using SpecPtr = std::unique_ptr<mjSpec, MujocoDelete>;
using ModelPtr = std::unique_ptr<mjModel, MujocoDelete>;
using DataPtr = std::unique_ptr<mjData, MujocoDelete>;

/// Routes MuJoCo's messages away from the terminal and from MUJOCO_LOG.TXT: warnings are counted in
/// mjData, where the world reads them; an error becomes a WorldFailure instead of ending the
/// process. The handler belongs to the process; installing it again changes nothing. Thread-safe.
void InstallMujocoLogHandler();

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
