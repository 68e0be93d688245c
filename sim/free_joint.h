#pragma once

#include <mujoco/mujoco.h>
#include <Eigen/Core>

#include "reckon/models/pose.h"

namespace reckon::sim {

/// Where a body on a free joint lies in MuJoCo's vectors. Its six velocities are linear in W and
/// angular in the body's axes.
struct FreeJoint {
  int pose_address = 0, twist_address = 0;

  FreeJoint() = default;

  /// Throws std::invalid_argument, which names the body, if it has no free joint.
  FreeJoint(const mjModel& model, int body);

  /// Of the positions of `data`. Neither allocates.
  models::Pose Pose(const mjData& data) const;
  void Place(const models::Pose& X_WB, mjData& data) const;
};

}  // namespace reckon::sim
