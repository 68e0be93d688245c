#include "reckon/sim/legged_model.h"

#include <cmath>
#include <stdexcept>

#include "reckon/sim/foot_contacts.h"
#include "reckon/sim/scenery.h"
#include "reckon/sim/walking_ground.h"

namespace reckon::sim {
namespace {

/// Friction is nearly as hard as contact: with the engine's own ratio of 1 a foot on a slope creeps
/// by millimetres a second.
constexpr double kImpratio = 100.0;
constexpr double kTolerance = 1e-8;

void SetOptions(mjSpec* spec) {
  mjOption& option = spec->option;
  option.integrator = mjINT_IMPLICITFAST;
  option.cone = mjCONE_ELLIPTIC;
  option.impratio = kImpratio;
  option.tolerance = kTolerance;
  // Here the engine has the joints' friction and stops.
  option.disableflags &= ~(mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT | mjDSBL_DAMPER);
}

/// The ground touches the robot, and the robot never itself.
void SetRobotGeoms(const TerrainConfig& terrain, mjSpec* spec) {
  for (auto* element = mjs_firstElement(spec, mjOBJ_GEOM); element != nullptr;
       element = mjs_nextElement(spec, element)) {
    mjsGeom* geom = mjs_asGeom(element);
    const bool touches = geom->contype != 0;
    geom->group = touches ? kHullGroup : kRobotGroup;
    geom->mass = 0.0;
    geom->contype = 0;
    geom->conaffinity = touches ? 1 : 0;
    if (!touches) continue;
    if (geom->type == mjGEOM_CYLINDER) geom->type = mjGEOM_CAPSULE;  // no edges to catch with
    SetGroundContact(terrain, 0, geom);
  }
}

void Lengthen(mjsBody* body, double offset) {
  const double length = std::hypot(body->pos[0], body->pos[1], body->pos[2]);
  if (!(length + offset > 0.0) || length == 0.0) {
    throw std::invalid_argument("actual: leg_offset_m leaves no length of a segment");
  }
  for (double& x : body->pos) x *= 1.0 + offset / length;
}

/// Segment k of a leg ends at joint k + 1, or at the foot.
void LengthenLeg(const models::UrdfRobot& urdf, const std::string& foot,
                 const std::vector<double>& offsets, mjSpec* spec) {
  std::size_t segment = 0;
  bool moving = false;
  for (const int j : models::JointsTo(urdf, urdf.LinkIndex(foot))) {
    const models::UrdfJoint& joint = urdf.joints()[static_cast<std::size_t>(j)];
    const std::string& link = urdf.links()[static_cast<std::size_t>(joint.child)].name;
    const bool ends = joint.type != models::JointType::kFixed || link == foot;
    if (moving && ends && segment < offsets.size()) {
      Lengthen(mjs_findBody(spec, link.c_str()), offsets[segment++]);
    }
    moving |= joint.type != models::JointType::kFixed;
  }
}

void SetJoint(const LeggedConfig& drive, const std::string& name, std::size_t k, mjSpec* spec) {
  mjsJoint* joint = mjs_asJoint(mjs_findElement(spec, mjOBJ_JOINT, name.c_str()));
  joint->armature = drive.armature_kg_m2[k];
  joint->damping[0] = drive.damping_n_m_s[k];
  joint->frictionloss = drive.friction_n_m[k];
}

void AddFoot(const std::string& name, double radius, const TerrainConfig& terrain, mjSpec* spec) {
  mjsGeom* sphere = mjs_addGeom(mjs_findBody(spec, name.c_str()), nullptr);
  mjs_setName(sphere->element, FootContacts::FootGeom(name).c_str());
  sphere->type = mjGEOM_SPHERE;
  sphere->size[0] = radius;
  sphere->mass = 0.0;
  sphere->contype = 0;
  sphere->conaffinity = 1;
  sphere->group = kRobotGroup;
  const float rubber[] = {0.10F, 0.10F, 0.10F, 1.0F};
  std::copy(rubber, rubber + 4, sphere->rgba);
  SetGroundContact(terrain, 2, sphere);
}

}  // namespace

ModelPtr BuildLeggedModel(const RobotConfig& robot, const WorldConfig& config,
                          const models::UrdfRobot& urdf, const LeggedBody& body,
                          const Terrain& terrain, std::uint64_t seed) {
  const auto& drive = std::get<LeggedConfig>(robot.drive);
  RobotSpec robot_spec(robot, config);
  mjSpec* spec = robot_spec.get();
  SetOptions(spec);
  SetRobotGeoms(config.terrain, spec);
  const double radius = drive.foot_radius_m + config.actual.foot_radius_offset_m;
  if (!(radius > 0.0)) {
    throw std::invalid_argument("actual: foot_radius_offset_m leaves no foot");
  }
  for (std::size_t i = 0; i < body.joints().size(); ++i) {
    SetJoint(drive, body.joints()[i], i % LeggedBody::kLegJoints, spec);
  }
  for (const std::string& foot : drive.feet) {
    LengthenLeg(urdf, foot, config.actual.leg_offset_m, spec);
    AddFoot(foot, radius, config.terrain, spec);
  }
  AddWalkingGround(terrain, config.patches, seed, spec, robot_spec.world());
  return robot_spec.Compile();
}

}  // namespace reckon::sim
