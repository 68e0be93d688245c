#pragma once

#include "reckon/sim/robot_config.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// The quadrupeds of models/, as the tests of this layer walk them.
inline RobotConfig MiniCheetah() {
  RobotConfig robot;
  robot.name = "mini_cheetah";
  robot.urdf_path = RECKON_SOURCE_DIR "/models/mini_cheetah/mini_cheetah.urdf";
  robot.base_link = "trunk";
  LeggedConfig drive;
  drive.feet = {"FR_foot", "FL_foot", "RR_foot", "RL_foot"};
  robot.drive = drive;
  return robot;
}

inline RobotConfig Raibo() {
  RobotConfig robot = MiniCheetah();
  robot.name = "raibo";
  robot.urdf_path = RECKON_SOURCE_DIR "/models/raibo/raibo.urdf";
  auto& drive = std::get<LeggedConfig>(robot.drive);
  drive.foot_radius_m = 0.03;
  drive.armature_kg_m2 = {0.025, 0.025, 0.035};
  drive.damping_n_m_s = {0.1, 0.1, 0.1};
  drive.friction_n_m = {0.4, 0.4, 0.4};
  drive.stand_angles_rad = {0, 0.5355, -1.0711};
  drive.swing_stiffness_n_m = 1500;
  drive.swing_damping_n_s_m = 55;
  return robot;
}

/// Flat ground, walked straight ahead from t = 1 s on; 0: it stands.
inline WorldConfig Walk(double speed_m_s) {
  WorldConfig config;
  if (speed_m_s == 0.0) return config;
  config.motion.path = PathKind::kVelocityProfile;
  config.motion.profile = {{1.0, speed_m_s, 0.0}};
  return config;
}

}  // namespace reckon::sim
