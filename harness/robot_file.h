#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reckon/harness/scenario.h"
#include "reckon/harness/yaml_node.h"
#include "reckon/models/suite.h"
#include "reckon/models/urdf_robot.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/sensor_suite.h"

namespace reckon::harness {

/// `models/<robot>/robot.yaml`: what a robot is beside its URDF. `drive`, `sensors` and `nominal`
/// are the defaults of the scenario's sections of the same names.
struct RobotFile {
  std::string description;
  std::string urdf;  ///< relative to the robot's folder
  std::string base_link = "base_link";
  sim::DriveConfig drive;
  std::map<std::string, SensorConfig> sensors;
  NominalConfig nominal;
};

/// A robot file as it was read: checked values, where they stand, and the file's folder.
struct LoadedRobotFile {
  RobotFile values;
  YamlNode root;
  std::filesystem::path folder;
};

/// Reads the file of the robot called `name`, which was asked for at `where`. Throws InputError.
LoadedRobotFile LoadRobotFile(const std::string& name, const Location& where);

/// A robot as a run needs it.
struct Robot {
  sim::RobotConfig simulated;
  models::Suite nominal;                 ///< by SensorId: the sensors in the order of their names
  std::vector<sim::SensorSpec> sensors;  ///< by SensorId: where they really are and what they do
  std::vector<std::string> joints;       ///< that encoders read: wheels, or joints leg by leg
  std::vector<std::string> feet;         ///< links, in the order of the legs
  std::vector<std::vector<std::string>> channels;  ///< by SensorId: names of a sample's entries
};

/// Builds the robot of a scenario, simulated or logged. Throws LogMissing, and InputError if its
/// files can't be read or a sensor's frame is not in the URDF.
Robot LoadRobot(const Scenario& scenario);

/// The same from a URDF that was read already.
Robot MakeRobot(const Scenario& scenario, const models::UrdfRobot& urdf);

}  // namespace reckon::harness
