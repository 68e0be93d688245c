#include "reckon/sim/walking_controller.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/sim/attitude.h"
#include "reckon/sim/rotation_vector.h"

namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / WalkingController::kRateHz;
constexpr double kTunedHeight = 0.29;  // m, of the robot that these numbers were found on

// The body: accelerations for errors of place and velocity, 1/s² and 1/s.
constexpr double kLevelP = 15.0, kLevelD = 8.0, kStandP = 60.0, kStandD = 10.0;
constexpr double kUpP = 120.0, kUpD = 18.0;
constexpr double kMostLevel = 6.0, kMostUp = 12.0, kMostDown = 7.0;  // m/s²
const Vector3d kTurnP(150.0, 150.0, 80.0), kTurnD(20.0, 20.0, 16.0);
constexpr double kFollowSlope = 0.8;  // share of the ground's slope that the body takes
constexpr double kMostLag = 0.04;     // m that the wanted place may run ahead
constexpr double kMostTurnLag = 0.2;  // rad

// The feet.
constexpr double kVelocityFilter = 0.04;              // s
constexpr double kFootholdGain = 0.06;                // s
constexpr double kLongestStep = 0.14;                 // m from under the hip
constexpr double kAimBelow = 0.012;                   // m into the ground
constexpr double kLastAim = 0.9;                      // of the swing
constexpr double kLift = 0.07, kTouchDown = 0.15;     // m, m/s
constexpr double kSearchSpeed = 0.7, kSearch = 0.12;  // m/s, m
constexpr double kLowerSpeed = 0.05, kLower = 0.06;   // m/s, m: until all feet are down
constexpr double kRamp = 0.12;                        // of the stance
constexpr double kFirstLoad = 0.4;
constexpr double kStanceDamping = 0.05;  // N m s
constexpr double kSingular = 1e-5;       // m²: a straight leg can't do what is asked

// Friction as it is believed.
constexpr double kSkates = 0.2;  // m/s
constexpr int kSkatingTicks = 5;
constexpr double kLeastFriction = 0.08, kMostFriction = 0.5;
constexpr double kLoseFriction = 10.0, kRegainFriction = 0.1;  // 1/s

double Towards(double now, double wanted, double step) {
  return now + std::clamp(wanted - now, -step, step);
}

Matrix3d AboutZ(double angle) {
  return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

WalkingController::WalkingController(const LeggedBody& body, const LeggedConfig& config,
                                     const ControlConfig& control, double gravity_m_s2)
    : body_(&body),
      config_(config),
      g_(gravity_m_s2),
      length_(body.stand_height_m() / kTunedHeight),
      time_(std::sqrt(length_)),
      lift_m_(control.gait.lift_m.value_or(kLift * length_)),
      clock_(NamedGait(control.gait, body.legs(), time_), body.legs()),
      plane_(body.legs()),
      distribution_(body.legs(), body.mass_kg() * gravity_m_s2, body.stand_height_m()),
      torque_(models::EncoderVector::Zero(body.stand_angles_rad().size())) {
  forces_.fill(Vector3d::Zero());
}

const models::EncoderVector& WalkingController::Update(const WalkCommand& command,
                                                       const ControlState& x) {
  yaw_ = HeadingOf(x.X_WB.R);
  ReadFeet(x);
  if (!started_) Start(x);
  FollowCommand(command, x);
  StartOrStop(command, x);
  LowerOntoGround(x);
  GaitClock::Contacts contacts{};
  for (int i = 0; i < body_->legs(); ++i) contacts[i] = feet_[i].contact;
  clock_.Update(kDt, contacts);
  for (int i = 0; i < body_->legs(); ++i) {
    if (clock_.state(i) != LegPhase::kStance || !feet_[i].contact) continue;
    stood_[i] = feet_[i].p_WF - body_->foot_radius_m() * Vector3d::UnitZ();
  }
  plane_.Update(stood_, x.X_WB.p.head<2>(), kDt);
  MoveReferences(x);
  AdaptFriction();
  Stand(x);
  for (int i = 0; i < body_->legs(); ++i) {
    torque_.segment<LeggedBody::kLegJoints>(LeggedBody::kLegJoints * i) =
        Guides(i) ? SwingTorque(i, x) : StanceTorque(i, x);
  }
  return torque_;
}

void WalkingController::Start(const ControlState& x) {
  started_ = true;
  for (int i = 0; i < body_->legs(); ++i) {
    stood_[i] = feet_[i].p_WF - body_->foot_radius_m() * Vector3d::UnitZ();
    feet_[i].landing = feet_[i].p_WF;
  }
  plane_.Start(stood_, x.X_WB.p.head<2>());
  p_wanted_ = x.X_WB.p.head<2>();
  yaw_wanted_ = yaw_;
}

void WalkingController::ReadFeet(const ControlState& x) {
  for (int i = 0; i < body_->legs(); ++i) {
    Foot& foot = feet_[i];
    foot.kinematics = body_->kinematics(i).Evaluate(x.joint_angle_rad);
    const Vector3d& p_BF = foot.kinematics.p_BF;
    const Vector3d moved = foot.kinematics.J * LeggedBody::Of(i, x.joint_rate_rad_s);
    foot.p_WF = x.X_WB * p_BF;
    foot.v_WF = x.v_WB + x.X_WB.R * (x.w_WB_B.cross(p_BF) + moved);
    foot.contact = x.contact[i] > 0.5;
  }
}

void WalkingController::FollowCommand(const WalkCommand& command, const ControlState& x) {
  for (int i = 0; i < 2; ++i) {
    command_[i] =
        Towards(command_[i], command.velocity_m_s[i], config_.max_acceleration_m_s2 * kDt);
  }
  yaw_rate_ = Towards(yaw_rate_, command.yaw_rate_rad_s, config_.max_yaw_acceleration_rad_s2 * kDt);
  v_command_ = AboutZ(yaw_).topLeftCorner<2, 2>() * command_;
  v_filtered_ += kDt / (kVelocityFilter * time_) * (x.v_WB.head<2>() - v_filtered_);
}

void WalkingController::StartOrStop(const WalkCommand& command, const ControlState& x) {
  if (!clock_.walking()) {
    if (!(command == WalkCommand{})) clock_.Start();
    return;
  }
  bool stands = command == WalkCommand{} && command_.norm() < 0.02 && std::abs(yaw_rate_) < 0.05 &&
                x.v_WB.norm() < 0.15;
  for (int i = 0; i < body_->legs(); ++i) {
    stands &= clock_.state(i) == LegPhase::kStance && feet_[i].contact;
  }
  if (stands) clock_.Stop();
}

/// The plane begins where all feet have found the ground.
void WalkingController::LowerOntoGround(const ControlState& x) {
  if (stands_) return;
  lowered_s_ += kDt;
  stands_ = std::all_of(feet_.begin(), feet_.begin() + body_->legs(),
                        [](const Foot& foot) { return foot.contact; });
  if (stands_) Start(x);
}

void WalkingController::MoveReferences(const ControlState& x) {
  yaw_wanted_ += yaw_rate_ * kDt;
  yaw_wanted_ = yaw_ + std::clamp(std::remainder(yaw_wanted_ - yaw_, 2.0 * std::numbers::pi),
                                  -kMostTurnLag, kMostTurnLag);
  const Vector2d p = x.X_WB.p.head<2>();
  if (clock_.walking()) {
    p_wanted_ += v_command_ * kDt;
    const double lag = kMostLag * length_;
    p_wanted_ = p_wanted_.cwiseMax((p.array() - lag).matrix()).cwiseMin((p.array() + lag).matrix());
    return;
  }
  Vector2d middle = Vector2d::Zero();
  for (int i = 0; i < body_->legs(); ++i) middle += stood_[i].head<2>() / body_->legs();
  p_wanted_ = middle - (x.X_WB.R * body_->p_BC()).head<2>();
}

void WalkingController::AdaptFriction() {
  bool skates = false;
  for (int i = 0; i < body_->legs(); ++i) {
    Foot& foot = feet_[i];
    const bool stands = clock_.state(i) == LegPhase::kStance && foot.contact;
    foot.skating = stands && foot.v_WF.head<2>().norm() > kSkates * time_ ? foot.skating + 1 : 0;
    skates |= foot.skating >= kSkatingTicks;
  }
  friction_ += (skates ? -kLoseFriction : kRegainFriction) * kDt;
  friction_ = std::clamp(friction_, kLeastFriction, kMostFriction);
}

Wrench WalkingController::BodyWrench(const ControlState& x) const {
  const auto& [R, p] = x.X_WB;
  const Vector2d& slope = plane_.slope();
  const bool walks = clock_.walking();
  Vector3d a;
  a.head<2>() = ((walks ? kLevelP : kStandP) * (p_wanted_ - p.head<2>())) / length_ +
                ((walks ? kLevelD : kStandD) * (v_command_ - x.v_WB.head<2>())) / time_;
  a.head<2>() = a.head<2>().cwiseMax(-kMostLevel).cwiseMin(kMostLevel).eval();
  const double z_wanted = plane_.height() + body_->stand_height_m();
  a.z() = kUpP * (z_wanted - p.z()) / length_ + kUpD * (slope.dot(v_command_) - x.v_WB.z()) / time_;
  a.z() = std::clamp(a.z(), -kMostDown, kMostUp);
  const Vector2d slope_yaw = AboutZ(-yaw_wanted_).topLeftCorner<2, 2>() * slope;
  const Matrix3d R_wanted =
      AboutZ(yaw_wanted_) *
      Eigen::AngleAxisd(-kFollowSlope * std::atan(slope_yaw.x()), Vector3d::UnitY()) *
      Eigen::AngleAxisd(kFollowSlope * std::atan(slope_yaw.y()), Vector3d::UnitX());
  const Vector3d w_wanted = R.transpose() * (yaw_rate_ * Vector3d::UnitZ());
  const Vector3d alpha = kTurnP.cwiseProduct(RotationLog(R.transpose() * R_wanted)) / length_ +
                         kTurnD.cwiseProduct(w_wanted - x.w_WB_B) / time_;
  Wrench wrench;
  wrench << body_->mass_kg() * (a + g_ * Vector3d::UnitZ()), R * (body_->inertia_kg_m2() * alpha);
  return wrench;
}

void WalkingController::Stand(const ControlState& x) {
  const Matrix3d R_YW = AboutZ(-yaw_);  // to the axes of the heading
  const Vector3d p_WC = x.X_WB * body_->p_BC();
  ForceDistribution::Feet feet;
  for (int i = 0; i < body_->legs(); ++i) {
    feet[i].stands = !Guides(i);
    feet[i].load = LoadOf(i);
    feet[i].r = R_YW * (feet_[i].p_WF - body_->foot_radius_m() * Vector3d::UnitZ() - p_WC);
  }
  const Wrench wrench = BodyWrench(x);
  Wrench turned;
  turned << R_YW * wrench.head<3>(), R_YW * wrench.tail<3>();
  const auto& forces = distribution_.Update(feet, turned, R_YW * plane_.normal(), friction_);
  for (int i = 0; i < body_->legs(); ++i) forces_[i] = R_YW.transpose() * forces[i];
}

/// A foot that swings or searches for the ground.
bool WalkingController::Guides(int leg) const {
  return clock_.walking() ? clock_.state(leg) != LegPhase::kStance : !stands_;
}

double WalkingController::LoadOf(int leg) const {
  if (!clock_.walking()) return 1.0;
  if (clock_.early(leg)) return kFirstLoad;
  const double ramp = kRamp * clock_.gait().duty, phase = clock_.phase(leg);
  const double rises = kFirstLoad + phase / ramp, falls = (clock_.gait().duty - phase) / ramp;
  return std::clamp(std::min(rises, falls), 0.0, 1.0);
}

WalkingController::Vector3 WalkingController::StanceTorque(int leg, const ControlState& x) const {
  const auto q = LeggedBody::Of(leg, x.joint_angle_rad);
  const Vector3d up_B = x.X_WB.R.transpose() * Vector3d::UnitZ();
  return -feet_[leg].kinematics.J.transpose() * (x.X_WB.R.transpose() * forces_[leg]) +
         body_->dynamics(leg).GravityTorque(q, up_B, g_) -
         kStanceDamping * LeggedBody::Of(leg, x.joint_rate_rad_s);
}

/// Where the leg will be under its hip in the middle of its stance, and half a stance's travel and
/// a correction of the velocity on top [Raibert86]; the last term keeps it on a curve.
WalkingController::Vector3 WalkingController::Foothold(int leg, const ControlState& x) const {
  const Gait& gait = clock_.gait();
  const double left_s = (1.0 - clock_.swing(leg)) * gait.swing_s();
  const double yaw = yaw_ + yaw_rate_ * (left_s + 0.5 * gait.stance_s());
  const Vector3d under_hip = AboutZ(yaw) * body_->stand_foot(leg);
  const Vector2d centripetal =
      0.5 * body_->stand_height_m() / g_ * yaw_rate_ * Vector2d(v_filtered_.y(), -v_filtered_.x());
  Vector2d step = 0.5 * gait.stance_s() * v_filtered_ +
                  kFootholdGain * time_ * (v_filtered_ - v_command_) + centripetal;
  const double longest = kLongestStep * length_;
  step = step.cwiseMax(-longest).cwiseMin(longest).eval();
  Vector3d foothold;
  foothold.head<2>() = x.X_WB.p.head<2>() + left_s * v_filtered_ + under_hip.head<2>() + step;
  foothold.z() = plane_.HeightAt(foothold.head<2>()) + body_->foot_radius_m() - kAimBelow * length_;
  return foothold;
}

SwingPoint WalkingController::Target(int leg, const ControlState& x) {
  Foot& foot = feet_[leg];
  if (!clock_.walking()) {
    const double down = std::min(kLowerSpeed * lowered_s_, kLower * length_);
    return {x.X_WB * (body_->stand_foot(leg) - down * Vector3d::UnitZ()), x.v_WB, Vector3d::Zero()};
  }
  if (clock_.state(leg) == LegPhase::kLate) {
    const double speed = kSearchSpeed * time_;
    const double down = std::min(speed * clock_.late_s(leg), kSearch * length_);
    return {foot.landing - down * Vector3d::UnitZ(), -speed * Vector3d::UnitZ(), Vector3d::Zero()};
  }
  if (clock_.lifted(leg)) foot.lift_off = foot.p_WF;
  const double s = clock_.swing(leg);
  if (s < kLastAim) foot.landing = Foothold(leg, x);
  return SwingAt(foot.lift_off, foot.landing, s, clock_.gait().swing_s(), lift_m_,
                 kTouchDown * time_);
}

WalkingController::Vector3 WalkingController::SwingTorque(int leg, const ControlState& x) {
  const Foot& foot = feet_[leg];
  const SwingPoint target = Target(leg, x);
  const Matrix3d R_BW = x.X_WB.R.transpose();
  const Matrix3d J = foot.kinematics.J;
  const auto q = LeggedBody::Of(leg, x.joint_angle_rad);
  Vector3d force = config_.swing_stiffness_n_m * (target.p - foot.p_WF) +
                   config_.swing_damping_n_s_m * (target.v - foot.v_WF);
  if (!stands_ && foot.contact) force.z() -= body_->mass_kg() * g_ / body_->legs();
  Vector3d torque = J.transpose() * (R_BW * force) +
                    body_->dynamics(leg).GravityTorque(q, R_BW * Vector3d::UnitZ(), g_);
  if (!target.a.isZero()) {
    const Matrix3d JJt = J * J.transpose() + kSingular * Matrix3d::Identity();
    torque +=
        body_->dynamics(leg).MassMatrix(q) * (J.transpose() * (JJt.inverse() * (R_BW * target.a)));
  }
  return torque;
}

}  // namespace reckon::sim
