#pragma once

#include <memory>
#include <string>

#include <mujoco/mujoco.h>

#include "reckon/sim/robot_config.h"
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

DataPtr MakeData(const mjModel& model);

/// A robot's URDF on a free joint in a world that is empty otherwise, before it is compiled:
/// `config.actual` has been applied to the base link, the options of the physics are set, and the
/// bodies have the collision shapes of the URDF.
class RobotSpec {
 public:
  /// Throws std::invalid_argument, which names the file and the thing at fault.
  RobotSpec(const RobotConfig& robot, const WorldConfig& config);

  mjSpec* get() const { return world_.get(); }
  mjsBody* world() const { return mjs_findBody(world_.get(), "world"); }
  mjsBody* base() const { return base_; }

  /// Without geoms a step is faster.
  void DeleteGeoms();

  /// Throws std::invalid_argument with MuJoCo's sentence.
  ModelPtr Compile();

 private:
  std::string urdf_path_;
  SpecPtr robot_, world_;  // the world refers to the robot, so it is destroyed first
  mjsBody* base_ = nullptr;
};

}  // namespace reckon::sim
