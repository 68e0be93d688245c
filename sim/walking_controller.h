#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/sim/control_state.h"
#include "reckon/sim/force_distribution.h"
#include "reckon/sim/gait.h"
#include "reckon/sim/legged_body.h"
#include "reckon/sim/legged_config.h"
#include "reckon/sim/support_plane.h"
#include "reckon/sim/swing_path.h"

namespace reckon::sim {

/// What is asked of a walking robot, in the axes of its heading.
struct WalkCommand {
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  double yaw_rate_rad_s = 0.0;

  bool operator==(const WalkCommand&) const = default;
};

/// Walks blind: forces of the standing feet make the wrench that keeps the body over a plane
/// through the last footholds; swinging feet aim for where the body will be. Nothing is known of
/// the ground but what the feet have felt, and nothing of its friction but that feet skate.
///
/// Tuned on a robot 0.29 m high; lengths grow with the height h, times with √h, forces with the
/// weight (dynamic similarity).
class WalkingController {
 public:
  static constexpr double kRateHz = 500.0;

  /// `body` must outlive it. Throws std::invalid_argument for a gait that can't be.
  WalkingController(const LeggedBody& body, const LeggedConfig& config,
                    const ControlConfig& control, double gravity_m_s2);

  /// One tick: the joint torques, within the motors' limits or not. Does not allocate.
  const models::EncoderVector& Update(const WalkCommand& command, const ControlState& state);

  const GaitClock& clock() const { return clock_; }
  double believed_friction() const { return friction_; }

 private:
  using Vector3 = Eigen::Vector3d;
  struct Foot {
    models::FootPosition kinematics;
    Vector3 p_WF, v_WF;
    Vector3 lift_off = Vector3::Zero(), landing = Vector3::Zero();
    bool contact = false;
    int skating = 0;  ///< ticks
  };

  void Start(const ControlState& x);
  void ReadFeet(const ControlState& x);
  void FollowCommand(const WalkCommand& command, const ControlState& x);
  void StartOrStop(const WalkCommand& command, const ControlState& x);
  void MoveReferences(const ControlState& x);
  void AdaptFriction();
  void LowerOntoGround(const ControlState& x);
  Wrench BodyWrench(const ControlState& x) const;
  void Stand(const ControlState& x);
  Vector3 Foothold(int leg, const ControlState& x) const;
  SwingPoint Target(int leg, const ControlState& x);
  bool Guides(int leg) const;
  double LoadOf(int leg) const;
  Vector3 StanceTorque(int leg, const ControlState& x) const;
  Vector3 SwingTorque(int leg, const ControlState& x);

  const LeggedBody* body_;
  LeggedConfig config_;
  double g_, length_, time_;  ///< gravity, and the scales of similarity
  double lift_m_;
  GaitClock clock_;
  SupportPlane plane_;
  ForceDistribution distribution_;
  std::array<Foot, models::kMaxFeet> feet_;
  SupportPlane::Points stood_;        ///< bottoms of the feet where they stood last
  ForceDistribution::Forces forces_;  ///< in W
  Eigen::Vector2d command_ = Eigen::Vector2d::Zero();    ///< ramped, in the axes of the heading
  Eigen::Vector2d v_command_ = Eigen::Vector2d::Zero();  ///< in W
  Eigen::Vector2d v_filtered_ = Eigen::Vector2d::Zero(), p_wanted_ = Eigen::Vector2d::Zero();
  double yaw_rate_ = 0.0, yaw_wanted_ = 0.0, yaw_ = 0.0, friction_ = 0.4;
  models::EncoderVector torque_;
  bool started_ = false;
  bool stands_ = false;     ///< all feet have found the ground once
  double lowered_s_ = 0.0;  ///< for how long they have been looking for it
};

}  // namespace reckon::sim
