#include "reckon/sim/legged_vehicle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "reckon/sim/attitude.h"
#include "reckon/sim/legged_model.h"
#include "reckon/sim/rotation_vector.h"
#include "reckon/sim/support_plane.h"
#include "reckon/sim/walking_ground.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using ConstVec3 = Eigen::Map<const Vector3d>;

constexpr double kStillSpeed = 0.02;  // m/s, rad/s
constexpr double kDrop = 0.003;       // m above the ground at first
constexpr double kFeels = 0.09;       // of the weight: a foot that presses so hard stands
constexpr double kFallenTiltDeg = 60.0;
constexpr double kHangingHeight = 3.0;  // times its standing height
constexpr double kRopeHz = 3.0;         // of a trunk that is hung up
constexpr double kRopeDamping = 0.7;

const LeggedConfig& DriveOf(const RobotConfig& robot) {
  return std::get<LeggedConfig>(robot.drive);
}

/// Over x = y = 0, yaw 0 and leaning as the ground under the feet does on the whole, at the least
/// height at which no foot is in it.
models::Pose StartPose(const LeggedBody& body, const Terrain& terrain) {
  SupportPlane plane(body.legs());
  SupportPlane::Points under{};
  for (int i = 0; i < body.legs(); ++i) {
    const Vector3d& foot = body.stand_foot(i);
    under[i] = {foot.x(), foot.y(), terrain.At(foot.x(), foot.y()).h};
  }
  plane.Start(under, Eigen::Vector2d::Zero());
  models::Pose X_WB;
  X_WB.R = StandOn(plane.slope());
  double height = -1e9;
  for (int i = 0; i < body.legs(); ++i) {
    const Vector3d foot = X_WB.R * body.stand_foot(i);
    height = std::max(height, terrain.At(foot.x(), foot.y()).h - foot.z());
  }
  const double radius = body.foot_radius_m() / X_WB.R(2, 2);
  X_WB.p.z() = height + radius + HighestOverTerrain(terrain.config()) + kDrop;
  return X_WB;
}

}  // namespace

LeggedVehicle::LeggedVehicle(const RobotConfig& robot, const WorldConfig& config,
                             std::uint64_t seed)
    : LeggedVehicle(robot, config, seed, models::UrdfRobot::FromFile(robot.urdf_path)) {}

LeggedVehicle::LeggedVehicle(const RobotConfig& robot, const WorldConfig& config,
                             std::uint64_t seed, const models::UrdfRobot& urdf)
    : LeggedVehicle(robot, config, seed, Terrain(config.terrain, config.patches, seed), urdf,
                    LeggedBody(urdf, DriveOf(robot))) {}

LeggedVehicle::LeggedVehicle(const RobotConfig& robot, const WorldConfig& config,
                             std::uint64_t seed, Terrain terrain, const models::UrdfRobot& urdf,
                             LeggedBody body)
    : Vehicle(BuildLeggedModel(robot, config, urdf, body, terrain, seed)),
      config_(config),
      terrain_(std::move(terrain)),
      body_(std::move(body)),
      controller_(body_, DriveOf(robot), config.control, config.gravity_m_s2),
      driver_(config.motion),
      base_(*model_, mj_name2id(model_.get(), mjOBJ_BODY, robot.base_link.c_str())),
      contacts_(*model_, DriveOf(robot).feet),
      push_draws_(seed, "pushes"),
      base_body_(mj_name2id(model_.get(), mjOBJ_BODY, robot.base_link.c_str())),
      control_period_ns_(NsPerCall(WalkingController::kRateHz, config.physics_step_s)),
      driver_period_ns_(NsPerCall(Driver::kRateHz, config.physics_step_s)),
      wanted_n_m_(models::EncoderVector::Zero(body_.stand_angles_rad().size())),
      torque_n_m_(wanted_n_m_) {
  for (std::size_t i = 0; i < body_.joints().size(); ++i) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, body_.joints()[i].c_str());
    joint_angle_address_.push_back(model_->jnt_qposadr[joint]);
    joint_rate_address_.push_back(model_->jnt_dofadr[joint]);
    data_->qpos[joint_angle_address_.back()] = body_.stand_angles_rad()[i];
  }
  start_ = StartPose(body_, terrain_);
  if (config.control.in_air) start_.p.z() += kHangingHeight * body_.stand_height_m();
  base_.Place(start_, *data_);
  mj_kinematics(model_.get(), data_.get());
}

VehicleState LeggedVehicle::Read() {
  VehicleState state;
  state.X_WB = base_.Pose(*data_);
  const auto count = static_cast<Eigen::Index>(joint_angle_address_.size());
  state.joint_angle_rad.resize(count);
  state.joint_rate_rad_s.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    state.joint_angle_rad[i] = data_->qpos[joint_angle_address_[i]];
    state.joint_rate_rad_s[i] = data_->qvel[joint_rate_address_[i]];
  }
  state.joint_command_n_m = wanted_n_m_;
  state.joint_torque_n_m = torque_n_m_;
  state.feet = feet_;
  return state;
}

ControlState LeggedVehicle::TrueState(const VehicleState& now) const {
  ControlState state;
  state.X_WB = now.X_WB;
  state.v_WB = ConstVec3(data_->qvel + base_.twist_address);
  state.w_WB_B = ConstVec3(data_->qvel + base_.twist_address + 3);
  state.joint_angle_rad = now.joint_angle_rad;
  state.joint_rate_rad_s = now.joint_rate_rad_s;
  state.contact.resize(body_.legs());
  const double feels = kFeels * body_.mass_kg() * config_.gravity_m_s2;
  for (int i = 0; i < body_.legs(); ++i) {
    state.contact[i] = feet_.foot[i].normal_n > feels ? 1.0 : 0.0;
  }
  return state;
}

void LeggedVehicle::Control(models::TimeNs t_ns, const VehicleState& now) {
  const ControlState state = TrueState(now);
  if (t_ns >= 0 && t_ns % driver_period_ns_ == 0) {
    const auto& [R, p] = state.X_WB;
    const DriveCommand asked = driver_.Update(models::Seconds(t_ns), p.head<2>(), HeadingOf(R));
    command_ = {{asked.speed_m_s, 0.0}, asked.yaw_rate_rad_s};
  }
  wanted_n_m_ = controller_.Update(command_, state);
  const auto& limit = body_.torque_limit_n_m();
  torque_n_m_ = wanted_n_m_.cwiseMax(-limit).cwiseMin(limit);
  for (std::size_t i = 0; i < joint_rate_address_.size(); ++i) {
    data_->qfrc_applied[joint_rate_address_[i]] = torque_n_m_[i];
  }
}

/// An impulse every so often, level and in a direction of its own.
void LeggedVehicle::Push(models::TimeNs t_ns) {
  if (!config_.pushes) return;
  const PushConfig& pushes = *config_.pushes;
  const double t_s = models::Seconds(t_ns), count = std::floor(t_s / pushes.every_s);
  const bool pushed = count >= 1.0 && t_s - count * pushes.every_s < pushes.for_s;
  double* force = data_->xfrc_applied + static_cast<std::ptrdiff_t>(6 * base_body_);
  const double angle = 2.0 * std::numbers::pi *
                       push_draws_.Uniform(0, static_cast<std::uint64_t>(std::max(0.0, count)));
  const double strength = pushed ? pushes.impulse_n_s / pushes.for_s : 0.0;
  force[0] = strength * std::cos(angle);
  force[1] = strength * std::sin(angle);
}

/// Ropes that hold the trunk where it began, with its weight and springs to all sides.
void LeggedVehicle::Hang() {
  const double w = 2.0 * std::numbers::pi * kRopeHz, damping = 2.0 * kRopeDamping * w;
  const auto [R, p] = base_.Pose(*data_);
  const Vector3d v = ConstVec3(data_->qvel + base_.twist_address);
  const Vector3d w_B = ConstVec3(data_->qvel + base_.twist_address + 3);
  Eigen::Map<Eigen::Matrix<double, 6, 1>> wrench(data_->qfrc_applied + base_.twist_address);
  const double mass = body_.mass_kg();
  wrench.head<3>() = mass * (w * w * (start_.p - p) - damping * v);
  wrench[2] += mass * config_.gravity_m_s2;
  const Vector3d tilt = RotationLog(start_.R.transpose() * R);
  wrench.tail<3>() = -body_.inertia_kg_m2() * (w * w * tilt + damping * w_B);
}

void LeggedVehicle::Step(models::TimeNs t_ns, VehicleState& now) {
  // Before the run `t_ns` stands still.
  const models::TimeNs since_ns = t_ns < 0 ? steps_++ * -t_ns : t_ns;
  if (since_ns % control_period_ns_ == 0) Control(t_ns, now);
  Push(t_ns);
  if (config_.control.in_air) Hang();
  contacts_.SetFriction(terrain_, *data_, *model_);
  mj_step(model_.get(), data_.get());
  feet_ = contacts_.Read(*model_, *data_);
  now.feet = feet_;
  now.joint_command_n_m = wanted_n_m_;
  now.joint_torque_n_m = torque_n_m_;
  now.gait.resize(body_.legs());
  for (int i = 0; i < body_.legs(); ++i) now.gait[i] = controller_.clock().scheduled(i) ? 1.0 : 0.0;
}

bool LeggedVehicle::IsSettled() const {
  return Eigen::Map<const Eigen::VectorXd>(data_->qvel, model_->nv).lpNorm<Eigen::Infinity>() <
         kStillSpeed;
}

std::optional<std::string> LeggedVehicle::Trouble(const VehicleState& state) const {
  const auto& [R, p] = state.X_WB;
  if (auto outside = terrain_.Outside(p.x(), p.y())) return outside;
  if (LeansBeyond(kFallenTiltDeg, R)) return "the robot fell: it tilted by more than 60 degrees";
  if (FootContacts::TrunkTouches(*model_, *data_))
    return "the robot fell: its trunk hit the ground";
  return std::nullopt;
}

}  // namespace reckon::sim
