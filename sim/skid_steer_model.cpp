#include "reckon/sim/skid_steer_model.h"

#include <stdexcept>

namespace reckon::sim {
namespace {

// Contacts of a 14 kg corner on a soft tyre: 53 ms, damping ratio 0.25.
constexpr double kSolref[] = {0.053, 0.25};
constexpr double kSolimp[] = {0.9, 0.95, 0.002, 0.5, 2.0};

constexpr double kBuried = -100.0;  // m: where a box waits that is no kerb

[[noreturn]] void Refuse(const std::string& source, const std::string& what) {
  throw std::invalid_argument(source + ": " + what);
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
  joint->armature = robot.skid_steer().wheel_armature_kg_m2;
  mjsBody* wheel = mjs_getParent(joint->element);
  wheel->pos[1] *= config.actual.track_scale;
  if (config.terrain.kind != TerrainKind::kKerbs) return;
  mjsGeom* sphere = mjs_addGeom(wheel, nullptr);
  mjs_setName(sphere->element, WheelContactGeom(joint_name).c_str());
  sphere->type = mjGEOM_SPHERE;
  sphere->size[0] = robot.skid_steer().wheel_radius_m * radius_scale;
  sphere->mass = 0.0;
  SetContact(sphere, true);
}

/// The few pairs of spheres and boxes are filtered faster one by one than through a tree.
void SetContactOptions(mjSpec* spec, TerrainKind terrain) {
  spec->option.disableflags |= terrain == TerrainKind::kKerbs ? mjDSBL_MIDPHASE | mjDSBL_ISLAND
                                                              : mjDSBL_CONSTRAINT | mjDSBL_CONTACT;
}

}  // namespace

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
  RobotSpec robot_spec(robot, config);
  mjSpec* spec = robot_spec.get();
  robot_spec.DeleteGeoms();  // drawings and collision shapes of the URDF play no part
  SetContactOptions(spec, config.terrain.kind);
  const auto& drive = robot.skid_steer();
  for (const auto& name : drive.left_joints) {
    PrepareWheel(spec, robot, config, name, config.actual.wheel_radius_scale[0]);
  }
  for (const auto& name : drive.right_joints) {
    PrepareWheel(spec, robot, config, name, config.actual.wheel_radius_scale[1]);
  }
  if (config.terrain.kind == TerrainKind::kKerbs) AddKerbs(robot_spec.world(), terrain);
  return robot_spec.Compile();
}

}  // namespace reckon::sim
