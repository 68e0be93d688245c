#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reckon/sim/legged_config.h"
#include "reckon/sim/mission.h"
#include "reckon/sim/range.h"
#include "reckon/sim/water_config.h"

namespace reckon::sim {

enum class TerrainKind { kFlat, kSlope, kRough, kKerbs, kStairs, kDebris, kGravel };

/// How the ground gives way under a foot: MuJoCo's `solref` and `solimp`.
struct GroundContactConfig {
  double time_constant_s = 0.01;
  double damping_ratio = 1.0;
  double impedance_min = 0.9, impedance_max = 0.95;
  double width_m = 0.001;  ///< penetration over which the impedance rises from one to the other

  static constexpr Range kTimeConstant{0.001, 1}, kDampingRatio = AboveUpTo(0, 10);
  static constexpr Range kImpedance{0.01, 0.9999}, kWidth{1e-5, 1};
};

/// The ground. Which fields count depends on `kind`.
struct TerrainConfig {
  TerrainKind kind = TerrainKind::kFlat;
  double friction = 0.8;
  double rolling_resistance = 0.015;
  double half_size_m = 40.0;  ///< the map is the square |x|, |y| ≤ half_size; beyond it a run ends
  double angle_deg = 10.0;    ///< slope: ground rises along `uphill_deg`
  double uphill_deg = 0.0;    ///< slope: direction of ascent, from +x towards +y
  double rms_m = 0.03;        ///< rough: standard deviation of the height
  double shortest_wave_m = 0.6;      ///< rough: cosines between these two wavelengths,
  double longest_wave_m = 8.0;       ///<        amplitude ∝ λ^0.8, scaled to the RMS
  double kerb_height_m = 0.04;       ///< kerbs: boxes across the path,
  double kerb_width_m = 0.30;        ///<        this wide (along x),
  double kerb_spacing_m = 3.0;       ///<        one every so many metres along x
  double step_height_m = 0.08;       ///< stairs: flights along x, up and down in turn,
  double step_depth_m = 0.30;        ///<        of treads this deep,
  int steps = 5;                     ///<        so many to a flight
  double piece_height_m = 0.05;      ///< debris: the highest of bars, bricks and boards,
  double pieces_per_m2 = 1.5;        ///<        so many lie about
  double stone_m = 0.05;             ///< gravel: across a stone, and
  double stone_height_m = 0.03;      ///<         how much higher one can lie than another
  GroundContactConfig contact = {};  ///< under feet

  static constexpr Range kFriction{0, 3}, kRollingResistance{0, 1}, kHalfSize{2, 1000};
  /// Rough ground is a table: one of 150 m has 9e6 nodes.
  static constexpr Range kRoughHalfSize{2, 150};
  static constexpr Range kAngle{-45, 45}, kUphill{-360, 360};
  /// The table's nodes lie 0.1 m apart, four of them to the shortest wave.
  static constexpr Range kRms{0, 1}, kWave{0.4, 1000};
  /// The chassis has no contacts: a kerb that could meet it is refused.
  static constexpr Range kStepHeight{1e-3, 0.5}, kStepDepth{0.05, 5}, kSteps{1, 100};
  static constexpr Range kPieceHeight{1e-3, 0.5}, kPieces{0, 20};
  static constexpr Range kStone{0.01, 1}, kStoneHeight{0, 0.5}, kGravelHalfSize{2, 40};
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
  double go_s = 0.0, stop_s = 0.0;  ///< stands `stop_s` after each `go_s` of going; 0: never
  std::vector<std::array<double, 2>> waypoints_m;  ///< waypoints: stops at the last one
  /// velocity profile: rows [t_s, v_m_s, yaw_rate_rad_s], held until the next row
  std::vector<std::array<double, 3>> profile;
};

/// How the simulated robot differs from the nominal one.
struct ActualConfig {
  std::array<double, 2> wheel_radius_scale{1.0, 1.0};  ///< left, right
  /// Legs: by how much each segment is longer, from a joint to the next one or to the foot, from
  /// the body outwards.
  std::vector<double> leg_offset_m;
  double foot_radius_offset_m = 0.0;                 ///< by how much the feet are larger
  std::map<std::string, double> encoder_offset_rad;  ///< that a joint's encoder reads too much
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
  ControlConfig control;             ///< of a robot on legs
  std::optional<PushConfig> pushes;  ///< of a robot on legs
  ActualConfig actual;

  static constexpr Range kPhysicsStep{1e-5, 0.005};
  /// Without weight nothing holds the robot on the ground.
  static constexpr Range kGravity = AboveUpTo(0, 30);
  static constexpr Range kSettle{0, 60};
};

}  // namespace reckon::sim
