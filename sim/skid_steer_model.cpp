#include "reckon/sim/skid_steer_model.h"

#include <array>
#include <stdexcept>
#include <vector>

#include "reckon/sim/world.h"

static_assert(mjVERSION_HEADER == 4000001,
              "MuJoCo 4.0.1 is needed: 4.0.0 solves sparse systems wrongly");

namespace reckon::sim {
namespace {

// Contacts of a 14 kg corner on a soft tyre: 53 ms, damping ratio 0.25.
constexpr double kSolref[] = {0.053, 0.25};
constexpr double kSolimp[] = {0.9, 0.95, 0.002, 0.5, 2.0};

constexpr double kBuried = -100.0;  // m: where a box waits that is no kerb

[[noreturn]] void Refuse(const std::string& source, const std::string& what) {
  throw std::invalid_argument(source + ": " + what);
}

void OnMujocoMessage(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) {
    throw WorldFailure(std::string("the physics engine failed: ") + message->subject);
  }
}

/// The spec of the URDF under a frame of an otherwise empty world.
struct Specs {
  SpecPtr robot, world;  // the world refers to the robot, so it is destroyed first
};

Specs ParseAndAttach(const RobotConfig& robot) {
  std::array<char, 1000> error{};
  Specs specs;
  specs.robot.reset(mj_parseXML(robot.urdf_path.c_str(), nullptr, error.data(), error.size()));
  if (!specs.robot) Refuse(robot.urdf_path, error.data());
  specs.robot->compiler.fusestatic = 0;
  specs.world.reset(mj_makeSpec());
  specs.world->compiler.fusestatic = 0;
  mjsBody* base = mjs_findBody(specs.robot.get(), robot.base_link.c_str());
  if (!base) Refuse(robot.urdf_path, "there is no link '" + robot.base_link + "'");
  mjsFrame* frame = mjs_addFrame(mjs_findBody(specs.world.get(), "world"), nullptr);
  if (!mjs_attach(frame->element, base->element, "", "")) {
    Refuse(robot.urdf_path, mjs_getError(specs.world.get()));
  }
  return specs;
}

/// Drawings and collision shapes of the URDF play no part: without geoms a step is faster.
void DeleteGeoms(mjSpec* spec) {
  std::vector<mjsElement*> geoms;
  for (auto* geom = mjs_firstElement(spec, mjOBJ_GEOM); geom; geom = mjs_nextElement(spec, geom)) {
    geoms.push_back(geom);
  }
  for (auto* geom : geoms) mjs_delete(spec, geom);
}

void ApplyActual(const ActualConfig& actual, mjsBody* base) {
  base->mass *= actual.mass_scale;
  for (double& moment : base->inertia) moment *= actual.mass_scale;
  // A full inertia that is not in use is NaN and stays so.
  for (double& moment : base->fullinertia) moment *= actual.mass_scale;
  for (int i = 0; i < 3; ++i) base->ipos[i] += actual.com_offset_m(i);
}

/// Wheels touch the ground, and nothing else touches anything.
void SetContact(mjsGeom* geom, bool wheel) {
  geom->condim = 1;
  geom->contype = wheel ? 1 : 2;
  geom->conaffinity = wheel ? 2 : 1;
  for (int i = 0; i < 2; ++i) geom->solref[i] = kSolref[i];
  for (int i = 0; i < 5; ++i) geom->solimp[i] = kSolimp[i];
}

void AddKerbs(mjsBody* world, const Terrain& terrain) {
  mjsGeom* plane = mjs_addGeom(world, nullptr);
  plane->type = mjGEOM_PLANE;
  plane->size[0] = plane->size[1] = terrain.config().half_size_m;
  plane->size[2] = 1.0;
  SetContact(plane, false);
  for (int i = 0; i < 2; ++i) {
    mjsBody* kerb = mjs_addBody(world, nullptr);
    kerb->mocap = 1;
    mjsGeom* box = mjs_addGeom(kerb, nullptr);
    box->type = mjGEOM_BOX;
    box->mass = 0.0;
    // Sunk into the plane, so that no wheel finds a lower edge.
    box->size[0] = terrain.config().kerb_width_m / 2;
    box->size[1] = terrain.config().half_size_m + 2.0;
    box->size[2] = terrain.config().kerb_height_m;
    SetContact(box, false);
  }
}

/// `radius_scale` is the actual wheel's over the nominal one's, of this side.
void PrepareWheel(mjSpec* spec, const RobotConfig& robot, const WorldConfig& config,
                  const std::string& joint_name, double radius_scale) {
  mjsJoint* joint = mjs_asJoint(mjs_findElement(spec, mjOBJ_JOINT, joint_name.c_str()));
  if (!joint) Refuse(robot.urdf_path, "there is no joint '" + joint_name + "'");
  joint->armature = robot.skid_steer.wheel_armature_kg_m2;
  mjsBody* wheel = mjs_getParent(joint->element);
  wheel->pos[1] *= config.actual.track_scale;
  if (config.terrain.kind != TerrainKind::kKerbs) return;
  mjsGeom* sphere = mjs_addGeom(wheel, nullptr);
  mjs_setName(sphere->element, WheelContactGeom(joint_name).c_str());
  sphere->type = mjGEOM_SPHERE;
  sphere->size[0] = robot.skid_steer.wheel_radius_m * radius_scale;
  sphere->mass = 0.0;
  SetContact(sphere, true);
}

void SetOptions(mjSpec* spec, const WorldConfig& config) {
  spec->option.timestep = config.physics_step_s;
  spec->option.gravity[0] = spec->option.gravity[1] = 0.0;
  spec->option.gravity[2] = -config.gravity_m_s2;
  spec->option.integrator = mjINT_EULER;
  // Motors, damping and tyres are forces of our own; a bad state must not be reset in silence.
  spec->option.disableflags |= mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT |
                               mjDSBL_SPRING | mjDSBL_DAMPER | mjDSBL_ACTUATION | mjDSBL_SENSOR |
                               mjDSBL_EULERDAMP | mjDSBL_AUTORESET;
  // The few pairs of spheres and boxes are filtered faster one by one than through a tree.
  spec->option.disableflags |= config.terrain.kind == TerrainKind::kKerbs
                                   ? mjDSBL_MIDPHASE | mjDSBL_ISLAND
                                   : mjDSBL_CONSTRAINT | mjDSBL_CONTACT;
}

}  // namespace

void InstallMujocoLogHandler() {
  if (mj_version() != mjVERSION_HEADER) {
    throw WorldFailure("the MuJoCo library that was loaded is not the version of the build, 4.0.1");
  }
  [[maybe_unused]] static const auto before = mju_setLogHandler(OnMujocoMessage);
}

std::string WheelContactGeom(const std::string& joint) { return joint + "/contact"; }

void PlaceKerbs(const Terrain& terrain, double robot_x_m, mjData& data) {
  const auto kerbs = terrain.KerbsAround(robot_x_m);
  for (int i = 0; i < 2; ++i) {
    data.mocap_pos[3 * i] = kerbs[i].value_or(0.0);
    data.mocap_pos[3 * i + 2] = kerbs[i] ? 0.0 : kBuried;
  }
}

ModelPtr BuildSkidSteerModel(const RobotConfig& robot, const WorldConfig& config,
                             const Terrain& terrain) {
  InstallMujocoLogHandler();
  const Specs specs = ParseAndAttach(robot);
  mjSpec* spec = specs.world.get();
  DeleteGeoms(spec);
  SetOptions(spec, config);
  mjsBody* base = mjs_findBody(spec, robot.base_link.c_str());
  mjsJoint* free = mjs_addFreeJoint(base);
  free->align = mjALIGNFREE_FALSE;  // qpos is the pose of the link's frame, not of its inertia
  ApplyActual(config.actual, base);
  const auto& drive = robot.skid_steer;
  for (const auto& name : drive.left_joints) {
    PrepareWheel(spec, robot, config, name, config.actual.wheel_radius_scale[0]);
  }
  for (const auto& name : drive.right_joints) {
    PrepareWheel(spec, robot, config, name, config.actual.wheel_radius_scale[1]);
  }
  if (config.terrain.kind == TerrainKind::kKerbs) AddKerbs(mjs_findBody(spec, "world"), terrain);
  ModelPtr model(mj_compile(spec, nullptr));
  if (!model) Refuse(robot.urdf_path, mjs_getError(spec));
  return model;
}

}  // namespace reckon::sim
