#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reckon/harness/scenario.h"
#include "reckon/harness/yaml_node.h"
#include "reckon/models/suite.h"

namespace reckon::harness {

/// One stream of a log: a CSV file, and what sent it.
struct LogSensor {
  models::SensorKind kind = models::SensorKind::kImu;
  std::string file;                    ///< in the log's folder
  double rate_hz = 0.0;                ///< nominal
  double latency_s = 0.0;              ///< from validity to arrival, where the file has no arrivals
  std::array<double, 3> position_m{};  ///< of the sensor's frame in the body
  std::array<double, 4> quaternion_wxyz{1, 0, 0, 0};  ///< R_BS
  std::vector<double> rotation_matrix;  ///< R_BS row by row instead; empty: the quaternion
  std::vector<std::string> channels;    ///< encoders, contacts: a name for each entry
  Eigen::Vector3d noise_m_per_s = Eigen::Vector3d::Zero();     ///< body velocity without covariance
  Eigen::Vector3d noise_position_m = Eigen::Vector3d::Zero();  ///< pose
  Eigen::Vector3d noise_orientation_rad = Eigen::Vector3d::Zero();  ///< pose
};

/// The legs of a logged robot; the channels of its encoders name the URDF's joints.
struct LogLegs {
  std::string urdf;  ///< in the log's folder
  std::string encoders, contacts;
  std::vector<std::string> feet;  ///< links, in the order of the contact sensor's channels
};

/// Where the robot was when the log began, for logs without truth.
struct LogStart {
  std::array<double, 3> position_m{};
  std::array<double, 4> quaternion_wxyz{1, 0, 0, 0};
  std::array<double, 3> velocity_m_s{}, gyro_bias_rad_s{}, accel_bias_m_s2{};
};

/// `log.yaml`: what the files of a log's folder are. Its `nominal` section is the default of a
/// scenario's.
struct LogFile {
  int schema = 1;
  std::string description;
  double gravity_m_s2 = 9.81;
  std::map<std::string, LogSensor> sensors;
  std::vector<std::string> left_wheels, right_wheels;  ///< channels of the wheels' encoders
  NominalConfig nominal;
  std::optional<LogLegs> legs;
  std::string truth;  ///< a CSV file in the folder; empty: nothing is known
  std::optional<LogStart> start;
};

/// A log's description as it was read: checked values, where they stand, and the folder.
struct LoadedLog {
  LogFile values;
  YamlNode root;
  std::filesystem::path folder;
};

/// There is no such log: what needs it can be skipped.
class LogMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads `<folder>/log.yaml`. Throws LogMissing, and InputError for what is wrong in it.
LoadedLog LoadLog(const std::filesystem::path& folder);

/// The suite of a log's robot, sensors in the order of their names. Throws InputError.
models::Suite SuiteOf(const LoadedLog& log);

/// The sensors of a log in the words of a scenario, so that what checks a scenario can see which
/// there are. Contacts, which are not simulated, have none.
std::map<std::string, SensorConfig> SensorsOf(const LogFile& log);

}  // namespace reckon::harness
