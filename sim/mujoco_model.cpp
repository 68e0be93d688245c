#include "reckon/sim/mujoco_model.h"

#include <array>
#include <new>
#include <stdexcept>
#include <vector>

#include "reckon/sim/world.h"

static_assert(mjVERSION_HEADER == 4000001,
              "MuJoCo 4.0.1 is needed: 4.0.0 solves sparse systems wrongly");

namespace reckon::sim {
namespace {

[[noreturn]] void Refuse(const std::string& source, const std::string& what) {
  throw std::invalid_argument(source + ": " + what);
}

void OnMujocoMessage(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) {
    throw WorldFailure(std::string("the physics engine failed: ") + message->subject);
  }
}

void ApplyActual(const ActualConfig& actual, mjsBody* base) {
  base->mass *= actual.mass_scale;
  for (double& moment : base->inertia) moment *= actual.mass_scale;
  // A full inertia that is not in use is NaN and stays so.
  for (double& moment : base->fullinertia) moment *= actual.mass_scale;
  for (int i = 0; i < 3; ++i) base->ipos[i] += actual.com_offset_m(i);
}

void SetOptions(mjSpec* spec, const WorldConfig& config) {
  spec->option.timestep = config.physics_step_s;
  spec->option.gravity[0] = spec->option.gravity[1] = 0.0;
  spec->option.gravity[2] = -config.gravity_m_s2;
  spec->option.integrator = mjINT_EULER;
  // Motors, damping, tyres and water are forces of our own; a bad state must not be reset in
  // silence.
  spec->option.disableflags |= mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT |
                               mjDSBL_SPRING | mjDSBL_DAMPER | mjDSBL_ACTUATION | mjDSBL_SENSOR |
                               mjDSBL_EULERDAMP | mjDSBL_AUTORESET;
}

}  // namespace

void InstallMujocoLogHandler() {
  if (mj_version() != mjVERSION_HEADER) {
    throw WorldFailure("the MuJoCo library that was loaded is not the version of the build, 4.0.1");
  }
  [[maybe_unused]] static const auto before = mju_setLogHandler(OnMujocoMessage);
}

DataPtr MakeData(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) throw std::bad_alloc();
  return data;
}

RobotSpec::RobotSpec(const RobotConfig& robot, const WorldConfig& config)
    : urdf_path_(robot.urdf_path) {
  InstallMujocoLogHandler();
  std::array<char, 1000> error{};
  robot_.reset(mj_parseXML(urdf_path_.c_str(), nullptr, error.data(), error.size()));
  if (!robot_) Refuse(urdf_path_, error.data());
  robot_->compiler.fusestatic = 0;
  world_.reset(mj_makeSpec());
  world_->compiler.fusestatic = 0;
  mjsBody* base = mjs_findBody(robot_.get(), robot.base_link.c_str());
  if (!base) Refuse(urdf_path_, "there is no link '" + robot.base_link + "'");
  mjsFrame* frame = mjs_addFrame(world(), nullptr);
  if (!mjs_attach(frame->element, base->element, "", "")) {
    Refuse(urdf_path_, mjs_getError(world_.get()));
  }
  SetOptions(world_.get(), config);
  base_ = mjs_findBody(world_.get(), robot.base_link.c_str());
  mjsJoint* free = mjs_addFreeJoint(base_);
  free->align = mjALIGNFREE_FALSE;  // qpos is the pose of the link's frame, not of its inertia
  ApplyActual(config.actual, base_);
}

void RobotSpec::DeleteGeoms() {
  std::vector<mjsElement*> geoms;
  for (auto* geom = mjs_firstElement(get(), mjOBJ_GEOM); geom;
       geom = mjs_nextElement(get(), geom)) {
    geoms.push_back(geom);
  }
  for (auto* geom : geoms) mjs_delete(get(), geom);
}

ModelPtr RobotSpec::Compile() {
  ModelPtr model(mj_compile(get(), nullptr));
  if (!model) Refuse(urdf_path_, mjs_getError(get()));
  return model;
}

}  // namespace reckon::sim
