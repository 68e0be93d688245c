#include "reckon/sim/underwater_vehicle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/sim/attitude.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

/// Nearer to the origin MuJoCo takes the centre of mass to lie in it, and stores a diagonal inertia
/// that added mass has no room in.
constexpr double kLeastOffset = 1e-6;  // m

const UnderwaterConfig& DriveOf(const RobotConfig& robot) {
  return std::get<UnderwaterConfig>(robot.drive);
}

ModelPtr BuildModel(const RobotConfig& robot, const WorldConfig& config, const Seabed& seabed) {
  RobotSpec spec(robot, config);
  mjsBody* base = spec.base();
  const double offset = std::hypot(base->ipos[0], base->ipos[1], base->ipos[2]);
  if (offset < kLeastOffset) base->ipos[2] = kLeastOffset;
  for (auto* element = mjs_firstElement(spec.get(), mjOBJ_GEOM); element != nullptr;
       element = mjs_nextElement(spec.get(), element)) {
    mjsGeom* geom = mjs_asGeom(element);
    geom->group = geom->contype != 0 ? kHullGroup : kRobotGroup;
    geom->mass = 0.0;
    SetHardContact(geom, config.terrain.friction);
  }
  AddSeabed(seabed, spec.get(), spec.world());
  ModelPtr model = spec.Compile();
  if (model->nv != 6) {
    throw std::invalid_argument(robot.urdf_path +
                                ": an underwater vehicle is one rigid body; joints must be fixed");
  }
  return model;
}

int BodyOf(const mjModel& model, const RobotConfig& robot) {
  return mj_name2id(&model, mjOBJ_BODY, robot.base_link.c_str());
}

/// Of the robot's hull over the origin of B, when it is level.
double TopOf(const mjModel& model, const mjData& data) {
  double top = 0.0;
  for (int i = 0; i < model.ngeom; ++i) {
    if (model.geom_group[i] != kHullGroup) continue;
    const double* box = model.geom_aabb + static_cast<std::ptrdiff_t>(6 * i);
    const double* R = data.geom_xmat + static_cast<std::ptrdiff_t>(9 * i);
    double height = data.geom_xpos[static_cast<std::ptrdiff_t>(3 * i) + 2];
    for (int k = 0; k < 3; ++k) height += R[6 + k] * box[k] + std::abs(R[6 + k]) * box[3 + k];
    top = std::max(top, height);
  }
  return top;
}

}  // namespace

UnderwaterVehicle::UnderwaterVehicle(const RobotConfig& robot, const WorldConfig& config,
                                     std::uint64_t seed)
    : UnderwaterVehicle(robot, config, seed, Seabed(config, seed)) {}

UnderwaterVehicle::UnderwaterVehicle(const RobotConfig& robot, const WorldConfig& config,
                                     std::uint64_t seed, Seabed seabed)
    : Vehicle(BuildModel(robot, config, seabed)),
      seabed_(std::move(seabed)),
      body_(*model_, BodyOf(*model_, robot)),
      hydrodynamics_("robot '" + robot.name + "'", DriveOf(robot).hydrodynamics,
                     config.water->density_kg_m3, config.gravity_m_s2),
      thrusters_("robot '" + robot.name + "'", DriveOf(robot).thrusters),
      current_(config.water->current, seed),
      autopilot_("robot '" + robot.name + "'", DriveOf(robot).autopilot),
      navigator_(config.mission),
      scenery_(*model_, *data_),
      step_s_(config.physics_step_s),
      control_period_steps_(StepsPerCall(Autopilot::kRateHz, config.physics_step_s)) {
  mj_forward(model_.get(), data_.get());  // at the origin
  top_m_ = TopOf(*model_, *data_);
  CheckMission();
  body_.Place({Eigen::Matrix3d::Identity(), navigator_.legs().front().route.At(0.0)}, *data_);
}

void UnderwaterVehicle::CheckMission() const {
  const auto depth_at = [this](double x, double y) {
    const auto hit = scenery_.Cast({x, y, 1.0}, -Vector3d::UnitZ());
    return hit ? hit->range_m - 1.0 : 0.0;
  };
  const auto trouble = MissionTrouble(navigator_.legs(), depth_at, top_m_);
  if (trouble) throw std::invalid_argument("mission: " + *trouble);
}

VehicleState UnderwaterVehicle::Read() {
  VehicleState state;
  state.X_WB = body_.Pose(*data_);
  return state;
}

void UnderwaterVehicle::Step(models::TimeNs t_ns, VehicleState& now) {
  const double t_s = models::Seconds(t_ns);
  mj_step1(model_.get(), data_.get());
  const Vector6 twist = body_.Twist(*data_);
  if (steps_++ % control_period_steps_ == 0) {
    const Course course = navigator_.Update(t_s, now.X_WB);
    wanted_ = autopilot_.Update(course, now.X_WB, twist, thrusters_.saturated());
  }
  const WaterMotion water = current_.At(std::max(0.0, t_s));
  now.water_velocity_m_s = water.velocity_m_s;
  const Vector6 wrench =
      hydrodynamics_.Wrench(now.X_WB.R, twist, water) + thrusters_.Update(wanted_, step_s_);
  body_.Apply(hydrodynamics_.added_mass(), wrench, *model_, *data_);
  mj_step2(model_.get(), data_.get());
}

std::optional<std::string> UnderwaterVehicle::Trouble(const VehicleState& state) const {
  const auto& p = state.X_WB.p;
  if (auto outside = seabed_.terrain().Outside(p.x(), p.y())) return outside;
  if (p.z() > -top_m_) {
    char text[160];
    std::snprintf(text, sizeof(text),
                  "the robot broke the surface (less than %.3g m deep), where its buoyancy is not "
                  "modelled",
                  top_m_);
    return text;
  }
  if (IsOverturned(state.X_WB.R)) return "the robot capsized";
  return std::nullopt;
}

}  // namespace reckon::sim
