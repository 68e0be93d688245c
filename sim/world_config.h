#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reckon/sim/mission.h"
#include "reckon/sim/range.h"
#include "reckon/sim/water_config.h"

namespace reckon::sim {

enum class TerrainKind { kFlat, kSlope, kRough, kKerbs };

/// The ground. Which fields count depends on `kind`.
struct TerrainConfig {
  TerrainKind kind = TerrainKind::kFlat;
  double friction = 0.8;
  double rolling_resistance = 0.015;
  double half_size_m = 40.0;  ///< the map is the square |x|, |y| ≤ half_size; beyond it a run ends
  double angle_deg = 10.0;    ///< slope: ground rises along `uphill_deg`
  double uphill_deg = 0.0;    ///< slope: direction of ascent, from +x towards +y
  double rms_m = 0.03;        ///< rough: standard deviation of the height
  double shortest_wave_m = 0.6;  ///< rough: cosines between these two wavelengths,
  double longest_wave_m = 8.0;   ///<        amplitude ∝ λ^0.8, scaled to the RMS
  double kerb_height_m = 0.04;   ///< kerbs: boxes across the path,
  double kerb_width_m = 0.30;    ///<        this wide (along x),
  double kerb_spacing_m = 3.0;   ///<        one every so many metres along x

  static constexpr Range kFriction{0, 3}, kRollingResistance{0, 1}, kHalfSize{2, 1000};
  /// Rough ground is a table: one of 150 m has 9e6 nodes.
  static constexpr Range kRoughHalfSize{2, 150};
  static constexpr Range kAngle{-45, 45}, kUphill{-360, 360};
  /// The table's nodes lie 0.1 m apart, four of them to the shortest wave.
  static constexpr Range kRms{0, 1}, kWave{0.4, 1000};
  /// The chassis has no contacts: a kerb that could meet it is refused.
  static constexpr Range kKerbHeight{1e-3, 0.12};
  static constexpr Range kKerbWidth{0.01, 100}, kKerbSpacing = AboveUpTo(0, 1000);
  /// The spacing exceeds the width by at least this: the robot stands between two kerbs.
  static constexpr double kRoomBetweenKerbs = 1.5;  // m
  double LeastKerbSpacing() const { return kerb_width_m + kRoomBetweenKerbs; }
};

/// A rectangle with another friction: [centre x, centre y, size x, size y].
struct PatchConfig {
  std::array<double, 4> box_m{0, 0, 1, 1};
  double friction = 0.15;

  static constexpr Range kBox{-1e4, 1e4};
};

enum class PathKind { kStand, kSquare, kCircle, kFigureEight, kWaypoints, kVelocityProfile };

/// What the driver is asked to do. Which fields count depends on `path`.
struct MotionConfig {
  PathKind path = PathKind::kStand;
  double speed_m_s = 0.8;
  double start_s = 1.0;   ///< the robot stands still until then
  double side_m = 10.0;   ///< square
  double radius_m = 5.0;  ///< circle, and each lobe of the figure of eight
  double laps = 1000.0;   ///< square, circle, figure of eight: then it stops
  bool clockwise = false;
  std::vector<std::array<double, 2>> waypoints_m;  ///< waypoints: stops at the last one
  /// velocity profile: rows [t_s, v_m_s, yaw_rate_rad_s], held until the next row
  std::vector<std::array<double, 3>> profile;
};

/// How the simulated robot differs from the nominal one.
struct ActualConfig {
  std::array<double, 2> wheel_radius_scale{1.0, 1.0};  ///< left, right
  double track_scale = 1.0;
  double mass_scale = 1.0;                                     ///< of the base link
  Eigen::Vector3d com_offset_m = Eigen::Vector3d::Zero();      ///< of the base link, in B
  Eigen::Vector3d imu_offset_m = Eigen::Vector3d::Zero();      ///< of the IMU's origin, in B
  Eigen::Vector3d imu_rotation_deg = Eigen::Vector3d::Zero();  ///< rotation vector, in B
};

/// Everything that the world is made from, beside the robot.
struct WorldConfig {
  double physics_step_s = 0.001;
  double gravity_m_s2 = 9.81;
  double settle_s = 1.0;  ///< the robot comes to rest before t = 0
  TerrainConfig terrain;
  std::vector<PatchConfig> patches;
  MotionConfig motion;               ///< of a robot on the ground
  std::optional<WaterConfig> water;  ///< the sea, of which `terrain` is the bottom
  MissionConfig mission;             ///< of an underwater vehicle
  ActualConfig actual;

  static constexpr Range kPhysicsStep{1e-5, 0.005};
  /// Without weight nothing holds the robot on the ground.
  static constexpr Range kGravity = AboveUpTo(0, 30);
  static constexpr Range kSettle{0, 60};
};

}  // namespace reckon::sim
