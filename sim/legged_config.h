#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reckon/sim/range.h"

namespace reckon::sim {

/// A robot on legs as the simulator builds it: what the URDF can't say. Lists hold one entry for
/// each joint of a leg, from the body outwards; all legs are alike.
struct LeggedConfig {
  std::vector<std::string> feet;  ///< URDF links: front right, front left, rear right, rear left
  double foot_radius_m = 0.02;    ///< of the sphere around a foot's origin
  std::vector<double> armature_kg_m2{0.0023, 0.0023, 0.0055};  ///< rotor times gear ratio squared
  std::vector<double> damping_n_m_s{0.03, 0.03, 0.03};         ///< viscous friction
  std::vector<double> friction_n_m{0.1, 0.1, 0.1};             ///< dry friction
  std::vector<double> stand_angles_rad{0.0, 0.8009, -1.679};   ///< of a leg that stands
  double swing_stiffness_n_m = 500.0;  ///< what guides a foot through the air
  double swing_damping_n_s_m = 14.0;
  double max_acceleration_m_s2 = 1.0;  ///< ramps of the command
  double max_yaw_acceleration_rad_s2 = 2.0;

  static constexpr Range kFootRadius = AboveUpTo(0, 0.5), kArmature{0, 10}, kFriction{0, 100};
  static constexpr Range kStiffness = AboveUpTo(0, 1e6), kDamping{0, 1e5};
  static constexpr Range kAngle{-6.3, 6.3}, kAcceleration = AboveUpTo(0, 100);
};

enum class GaitKind { kTrot, kWalk, kPace, kPronk, kBound };

/// When which foot is down. What is not given is the gait's own (`NamedGait`).
struct GaitConfig {
  GaitKind kind = GaitKind::kTrot;
  std::optional<double> period_s, duty;        ///< of a stride; its share in stance
  std::optional<std::vector<double>> offsets;  ///< of each foot's phase, in strides
  std::optional<double> lift_m;                ///< how high a foot swings

  static constexpr Range kPeriod{0.1, 5}, kDuty{0.1, 0.95}, kOffset{0, 1}, kLift = AboveUpTo(0, 1);
};

/// The walking controller.
struct ControlConfig {
  GaitConfig gait;
  bool in_air = false;  ///< hung up by its trunk: it walks without touching anything
};

/// Impulses on the body, level and in a random direction.
struct PushConfig {
  double impulse_n_s = 2.0;
  double every_s = 6.0;
  double for_s = 0.1;

  static constexpr Range kImpulse{0, 1e4}, kEvery = AboveUpTo(0, 1e5), kFor = AboveUpTo(0, 10);
};

}  // namespace reckon::sim
