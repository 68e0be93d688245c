#pragma once

#include "reckon/sim/robot_config.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// The BlueROV2 of models/, as the tests of this layer drive it.
inline RobotConfig BlueRov2() {
  RobotConfig robot;
  robot.name = "bluerov2";
  robot.urdf_path = RECKON_SOURCE_DIR "/models/bluerov2/bluerov2.urdf";
  UnderwaterConfig drive;
  drive.hydrodynamics.volume_m3 = 0.0134;
  drive.hydrodynamics.p_BV_m = {0, 0, 0.01};
  Vector6 diagonal;
  diagonal << 6.36, 7.12, 18.68, 0.189, 0.135, 0.222;
  drive.hydrodynamics.added_mass = diagonal.asDiagonal();
  drive.hydrodynamics.linear_damping << 13.7, 0, 33, 0, 0.8, 0;
  drive.hydrodynamics.quadratic_damping << 141, 217, 190, 1.19, 0.47, 1.5;
  for (const double x : {0.156, -0.156}) {
    for (const double y : {0.111, -0.111}) {
      drive.thrusters.push_back({{x, y, -0.085}, {1, x * y > 0 ? -1.0 : 1.0, 0}});
    }
  }
  for (const double x : {0.12, -0.12}) {
    for (const double y : {0.218, -0.218}) drive.thrusters.push_back({{x, y, 0}, {0, 0, 1}});
  }
  robot.drive = drive;
  return robot;
}

/// Half the height of its hull.
inline constexpr double kHalfHull = 0.127;

/// Still water, 10 m deep.
inline WorldConfig Sea() {
  WorldConfig config;
  config.water.emplace();
  return config;
}

}  // namespace reckon::sim
