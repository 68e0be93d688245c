#include "reckon/sim/skid_steer_vehicle.h"

#include <cmath>
#include <utility>

#include "reckon/sim/attitude.h"
#include "reckon/sim/skid_steer_model.h"

namespace reckon::sim {
namespace {

constexpr double kStillSpeed = 1e-6;  // m/s and rad/s: the robot is at rest

/// Checked before MuJoCo meets it: these messages are the clearer ones.
models::UrdfRobot ReadUrdf(const RobotConfig& robot, const ActualConfig& actual) {
  auto urdf = models::UrdfRobot::FromFile(robot.urdf_path);
  SkidSteer::Check(robot, actual, urdf);
  return urdf;
}

}  // namespace

SkidSteerVehicle::SkidSteerVehicle(const RobotConfig& robot, const WorldConfig& config,
                                   std::uint64_t seed)
    : SkidSteerVehicle(robot, config, Terrain(config.terrain, config.patches, seed),
                       ReadUrdf(robot, config.actual)) {}

SkidSteerVehicle::SkidSteerVehicle(const RobotConfig& robot, const WorldConfig& config,
                                   Terrain terrain, const models::UrdfRobot& urdf)
    : Vehicle(BuildSkidSteerModel(robot, config, terrain)),
      terrain_(std::move(terrain)),
      driver_(config.motion),
      steer_(robot, config, urdf, *model_),
      driver_period_ns_(NsPerCall(Driver::kRateHz, config.physics_step_s)) {
  const Ground ground = terrain_.At(0.0, 0.0);
  const Eigen::Matrix3d R_WB = StandOn({ground.hx, ground.hy});
  const double z = ground.h + steer_.RestHeight(*model_) / R_WB(2, 2);
  steer_.PlaceBase({R_WB, {0.0, 0.0, z}}, *data_);
  steer_.SetBrake(true);
}

VehicleState SkidSteerVehicle::Read() {
  steer_.ReadWheels(*data_);
  VehicleState state;
  state.X_WB = steer_.BasePose(*data_);
  state.joint_angle_rad = steer_.angle_rad();
  state.joint_rate_rad_s = steer_.rate_rad_s();
  state.wheel_slip_m_s = steer_.slip_m_s();
  state.wheel_load_n = steer_.load_n();
  return state;
}

void SkidSteerVehicle::Step(models::TimeNs t_ns, VehicleState& now) {
  if (t_ns >= 0 && t_ns % driver_period_ns_ == 0) {
    const auto& [R, p] = now.X_WB;
    command_ = driver_.Update(models::Seconds(t_ns), p.head<2>(), HeadingOf(R));
  }
  steer_.Apply(command_, terrain_, *data_);
  now.wheel_slip_m_s = steer_.slip_m_s();
  now.wheel_load_n = steer_.load_n();
  // Equal to mj_step1, forces, mj_step2: the forces follow from positions and velocities alone.
  mj_step(model_.get(), data_.get());
}

bool SkidSteerVehicle::IsSettled() const {
  return Eigen::Map<const Eigen::VectorXd>(data_->qvel, model_->nv).lpNorm<Eigen::Infinity>() <
         kStillSpeed;
}

std::optional<std::string> SkidSteerVehicle::Trouble(const VehicleState& state) const {
  const auto& p = state.X_WB.p;
  if (auto outside = terrain_.Outside(p.x(), p.y())) return outside;
  if (IsOverturned(state.X_WB.R)) return "the robot turned over";
  return std::nullopt;
}

}  // namespace reckon::sim
