#pragma once

#include <string>

#include "reckon/sim/robot_config.h"

namespace reckon::sim {

/// The Husky of models/, as the tests of this layer drive it.
inline RobotConfig Husky() {
  RobotConfig robot;
  robot.name = "husky";
  robot.urdf_path = RECKON_SOURCE_DIR "/models/husky/husky.urdf";
  robot.skid_steer().left_joints = {"front_left_wheel", "rear_left_wheel"};
  robot.skid_steer().right_joints = {"front_right_wheel", "rear_right_wheel"};
  return robot;
}

}  // namespace reckon::sim
