#pragma once

#include <string>
#include <variant>
#include <vector>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/legged_config.h"
#include "reckon/sim/underwater_config.h"

namespace reckon::sim {

/// A skid-steer drive as the simulator builds it: what the URDF can't say. Names are URDF joints.
struct SkidSteerConfig {
  std::vector<std::string> left_joints, right_joints;  ///< front to rear
  double wheel_radius_m = 0.1651;
  double wheel_armature_kg_m2 = 0.06;
  double wheel_damping_n_m_s = 0.1;
  double torque_limit_n_m = 40.0;  ///< at each wheel: a side of n wheels has n times as much
  double speed_kp = 25.0;          ///< PI loop on a side's mean speed, N m a wheel per rad/s
  double speed_ki = 150.0;
  double belt_stiffness_n_m_rad = 2500.0;  ///< a belt makes the wheels of a side turn together:
  double belt_damping_n_m_s = 8.0;         ///< torque on a wheel that leaves its side's mean
  double max_acceleration_m_s2 = 1.0;      ///< ramps of the command
  double max_yaw_acceleration_rad_s2 = 2.0;
  double command_track_m = 0.555;  ///< geometric track that turns (v, ω) into wheel speeds
  // The tyre, `vehicles.md` A.
  double bristle_stiffness_n_m = 25e3;
  double bristle_damping_n_s_m = 60.0;
  double relaxation_length_m = 0.05;
  double normal_stiffness_n_m = 32e3;
  double normal_damping_n_s_m = 500.0;
};

/// What moves a robot. The alternatives are in the order of `DriveKind`.
using DriveConfig = std::variant<SkidSteerConfig, UnderwaterConfig, LeggedConfig>;
enum class DriveKind { kSkidSteer, kUnderwater, kLegged };

inline DriveKind KindOf(const DriveConfig& drive) { return static_cast<DriveKind>(drive.index()); }

/// The robot that is simulated: its URDF and its drive.
struct RobotConfig {
  std::string name;  ///< a folder in models/
  std::string urdf_path;
  std::string base_link = "base_link";
  DriveConfig drive;

  /// For a robot that has this drive.
  const SkidSteerConfig& skid_steer() const { return std::get<SkidSteerConfig>(drive); }
  SkidSteerConfig& skid_steer() { return std::get<SkidSteerConfig>(drive); }
};

/// Whether a drive can turn this joint of `urdf`: a continuous one whose parent is `base_link`.
bool IsWheelJoint(const models::UrdfRobot& urdf, const models::UrdfJoint& joint,
                  const std::string& base_link);

}  // namespace reckon::sim
