#include "reckon/sim/skid_steer.h"

#include <cmath>
#include <stdexcept>

namespace reckon::sim {
namespace {

constexpr double kBrakedTyreDamping = 600.0;  // N s/m: about half of critical for a braked robot

using Vec3 = Eigen::Map<Eigen::Vector3d>;
using ConstVec3 = Eigen::Map<const Eigen::Vector3d>;

[[noreturn]] void Refuse(const std::string& robot, const std::string& what) {
  throw std::invalid_argument("robot '" + robot + "': " + what);
}

void CheckNumbers(const RobotConfig& robot, const ActualConfig& actual) {
  const auto& c = robot.skid_steer();
  const auto require = [&](bool holds, const char* key, const char* what) {
    if (!holds) Refuse(robot.name, std::string(key) + " must be " + what);
  };
  require(!c.left_joints.empty() && !c.right_joints.empty(), "left_joints and right_joints",
          "lists of at least one wheel");
  require(c.left_joints.size() + c.right_joints.size() <= models::kMaxEncoders,
          "left_joints and right_joints", "at most 16 wheels together");
  const std::pair<const char*, double> positive[] = {
      {"wheel_radius_m", c.wheel_radius_m},
      {"torque_limit_n_m", c.torque_limit_n_m},
      {"max_acceleration_m_s2", c.max_acceleration_m_s2},
      {"max_yaw_acceleration_rad_s2", c.max_yaw_acceleration_rad_s2},
      {"command_track_m", c.command_track_m},
      {"bristle_stiffness_n_m", c.bristle_stiffness_n_m},
      {"relaxation_length_m", c.relaxation_length_m},
      {"normal_stiffness_n_m", c.normal_stiffness_n_m},
      {"actual.wheel_radius_scale", actual.wheel_radius_scale[0]},
      {"actual.wheel_radius_scale", actual.wheel_radius_scale[1]},
      {"actual.track_scale", actual.track_scale},
      {"actual.mass_scale", actual.mass_scale}};
  for (const auto& [key, value] : positive) {
    require(value > 0 && std::isfinite(value), key, "positive");
  }
  const std::pair<const char*, double> not_negative[] = {
      {"wheel_armature_kg_m2", c.wheel_armature_kg_m2},
      {"wheel_damping_n_m_s", c.wheel_damping_n_m_s},
      {"speed_kp", c.speed_kp},
      {"speed_ki", c.speed_ki},
      {"belt_stiffness_n_m_rad", c.belt_stiffness_n_m_rad},
      {"belt_damping_n_m_s", c.belt_damping_n_m_s},
      {"bristle_damping_n_s_m", c.bristle_damping_n_s_m},
      {"normal_damping_n_s_m", c.normal_damping_n_s_m}};
  for (const auto& [key, value] : not_negative) {
    require(value >= 0 && std::isfinite(value), key, "zero or positive");
  }
  require(actual.com_offset_m.allFinite(), "actual.com_offset_m", "finite");
}

}  // namespace

void SkidSteer::Check(const RobotConfig& robot, const ActualConfig& actual,
                      const models::UrdfRobot& urdf) {
  CheckNumbers(robot, actual);
  urdf.LinkIndex(robot.base_link);
  for (const auto* side : {&robot.skid_steer().left_joints, &robot.skid_steer().right_joints}) {
    for (const auto& name : *side) {
      if (!IsWheelJoint(urdf, urdf.joints()[urdf.JointIndex(name)], robot.base_link)) {
        Refuse(robot.name, "wheel '" + name + "' is not a continuous joint of " + robot.base_link);
      }
    }
  }
}

SkidSteer::SkidSteer(const RobotConfig& robot, const WorldConfig& config,
                     const models::UrdfRobot& urdf, const mjModel& model)
    : drive_(robot.skid_steer()),
      damping_n_s_m_(robot.skid_steer().bristle_damping_n_s_m),
      dt_s_(config.physics_step_s),
      kerbs_(config.terrain.kind == TerrainKind::kKerbs),
      base_(model, mj_name2id(&model, mjOBJ_BODY, robot.base_link.c_str())) {
  for (const auto& joint : robot.skid_steer().left_joints) {
    AddWheel(robot, config, urdf, model, joint, config.actual.wheel_radius_scale[0]);
  }
  for (const auto& joint : robot.skid_steer().right_joints) {
    AddWheel(robot, config, urdf, model, joint, config.actual.wheel_radius_scale[1]);
  }
  kerb_contacts_.resize(wheels_.size());
  angle_ = rate_ = slip_ = load_ = models::EncoderVector::Zero(static_cast<int>(wheels_.size()));
}

void SkidSteer::AddWheel(const RobotConfig& robot, const WorldConfig& config,
                         const models::UrdfRobot& urdf, const mjModel& model,
                         const std::string& joint_name, double radius_scale) {
  const auto& joint = urdf.joints()[urdf.JointIndex(joint_name)];
  const auto& c = robot.skid_steer();
  Wheel wheel;
  wheel.p_BW = joint.X_PJ.p;
  wheel.p_BW.y() *= config.actual.track_scale;
  wheel.axis_B = joint.X_PJ.R * joint.axis;
  const int id = mj_name2id(&model, mjOBJ_JOINT, joint_name.c_str());
  wheel.angle_address = model.jnt_qposadr[id];
  wheel.rate_address = model.jnt_dofadr[id];
  wheel.geom = mj_name2id(&model, mjOBJ_GEOM, WheelContactGeom(joint_name).c_str());
  wheel.tyre = {c.wheel_radius_m * radius_scale,  c.bristle_stiffness_n_m,
                c.bristle_damping_n_s_m,          c.relaxation_length_m,
                c.normal_stiffness_n_m,           c.normal_damping_n_s_m,
                config.terrain.rolling_resistance};
  wheels_.push_back(wheel);
}

void SkidSteer::SetBrake(bool on) {
  drive_.SetBrake(on);
  for (auto& wheel : wheels_) wheel.tyre.damping_n_s_m = on ? kBrakedTyreDamping : damping_n_s_m_;
}

double SkidSteer::RestHeight(const mjModel& model) const {
  const double share = 1.0 / static_cast<double>(wheels_.size());
  const double load = -model.opt.gravity[2] * mj_getTotalmass(&model) * share;
  double height = 0.0;
  for (const auto& wheel : wheels_) {
    const double depth = load / wheel.tyre.normal_stiffness_n_m;
    height += share * (wheel.tyre.radius_m - depth - wheel.p_BW.z());
  }
  return height;
}

void SkidSteer::ReadWheels(const mjData& data) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    angle_(i) = data.qpos[wheels_[i].angle_address];
    rate_(i) = data.qvel[wheels_[i].rate_address];
  }
}

void SkidSteer::Apply(const DriveCommand& command, const Terrain& terrain, mjData& data) {
  ReadWheels(data);
  const models::Pose X_WB = BasePose(data);
  if (kerbs_) {
    ReadKerbContacts(data);
    PlaceKerbs(terrain, X_WB.p.x(), data);
  }
  const models::EncoderVector torque = drive_.Update(command, angle_, rate_, dt_s_);
  const Eigen::Vector3d v_WB = ConstVec3(data.qvel + base_.twist_address);
  const Eigen::Vector3d w_WB = X_WB.R * ConstVec3(data.qvel + base_.twist_address + 3);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // on B, in W
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    const Eigen::Vector3d arm = X_WB.R * wheel.p_BW, axle = X_WB.R * wheel.axis_B;
    const WheelMotion motion{X_WB.p + arm, v_WB + w_WB.cross(arm), w_WB + axle * rate_(i), axle,
                             rate_(i)};
    const WheelContact contact =
        kerbs_ ? kerb_contacts_[i] : SmoothContact(terrain, wheel.tyre, motion);
    const double friction = terrain.Friction(contact.point.x(), contact.point.y());
    const TyreForce tyre = wheel.state.Update(wheel.tyre, motion, contact, friction, dt_s_);
    // MuJoCo presses on kerbs by itself; on smooth ground the pressure is ours too.
    const Eigen::Vector3d pressure =
        kerbs_ ? 0.0 * contact.normal : contact.load_n * contact.normal;
    const Eigen::Vector3d total = tyre.force + pressure;
    force += total;
    moment += (contact.point - X_WB.p).cross(total);
    data.qfrc_applied[wheel.rate_address] =
        torque(i) + tyre.spin_torque_n_m + axle.dot((contact.point - motion.centre).cross(total));
    slip_(i) = tyre.slip_m_s;
    load_(i) = contact.load_n;
  }
  Vec3(data.qfrc_applied + base_.twist_address) = force;
  Vec3(data.qfrc_applied + base_.twist_address + 3) = X_WB.R.transpose() * moment;
}

/// Load, normal and point of each wheel: sums and force-weighted means over its contacts.
void SkidSteer::ReadKerbContacts(const mjData& data) {
  for (auto& contact : kerb_contacts_) {
    contact = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
  }
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& touch = data.contact[i];
    if (touch.efc_address < 0) continue;
    for (std::size_t w = 0; w < wheels_.size(); ++w) {
      const bool second = touch.geom[1] == wheels_[w].geom;
      if (!second && touch.geom[0] != wheels_[w].geom) continue;
      const double load = data.efc_force[touch.efc_address];
      const Eigen::Vector3d normal = (second ? 1.0 : -1.0) * ConstVec3(touch.frame);
      // MuJoCo's point lies halfway into the overlap; the tyre's is at two thirds of it from
      // outside.
      const double depth = -touch.dist;
      const Eigen::Vector3d point = ConstVec3(touch.pos) - normal * (depth / 6.0);
      kerb_contacts_[w].normal += load * normal;
      kerb_contacts_[w].point += load * point;
      kerb_contacts_[w].load_n += load;
    }
  }
  for (auto& contact : kerb_contacts_) {
    if (contact.load_n <= 0.0) continue;
    contact.normal.normalize();
    contact.point /= contact.load_n;
  }
}

}  // namespace reckon::sim
