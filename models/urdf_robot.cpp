#include "reckon/models/urdf_robot.h"

#include <cassert>
#include <cmath>
#include <fstream>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#include <Eigen/Eigenvalues>

namespace reckon::models {
namespace {

[[noreturn]] void Refuse(const std::string& source, const std::string& what) {
  throw std::invalid_argument(source + ": " + what);
}

/// urdfdom logs its complaints; they belong in the exception, not on the terminal.
class ParserLog : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

urdf::ModelInterfaceSharedPtr Parse(const std::string& xml, const std::string& source) {
  static std::mutex one_parser;  // the log handler belongs to the process
  const std::lock_guard lock(one_parser);
  ParserLog log;
  auto* before = console_bridge::getOutputHandler();
  console_bridge::useOutputHandler(&log);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(xml);
  } catch (...) {
    model.reset();  // the log says why
  }
  console_bridge::useOutputHandler(before);
  if (!model || !model->getRoot()) {
    Refuse(source, "not a URDF robot" + (log.text().empty() ? "" : " (" + log.text() + ")"));
  }
  return model;
}

Pose ToPose(const urdf::Pose& pose) {
  const auto& q = pose.rotation;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(),
          {pose.position.x, pose.position.y, pose.position.z}};
}

bool PositiveSize(const urdf::Geometry& geometry) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return static_cast<const urdf::Sphere&>(geometry).radius > 0;
    case urdf::Geometry::BOX: {
      const auto& dim = static_cast<const urdf::Box&>(geometry).dim;
      return dim.x > 0 && dim.y > 0 && dim.z > 0;
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return cylinder.radius > 0 && cylinder.length > 0;
    }
    case urdf::Geometry::MESH:
      return true;
  }
  return false;
}

void CheckGeometry(const urdf::Link& link, const std::string& source) {
  const auto check = [&](const auto& shapes) {
    for (const auto& shape : shapes) {
      if (!shape->geometry || !PositiveSize(*shape->geometry)) {
        Refuse(source, "link '" + link.name + "' has a geometry whose size is not positive");
      }
    }
  };
  check(link.visual_array);
  check(link.collision_array);
}

/// A rigid body's principal moments are positive and none exceeds the sum of the other two.
bool Physical(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  return inertia.allFinite() && moments(0) > 0 && moments(0) + moments(1) >= moments(2);
}

std::optional<UrdfInertial> ReadInertial(const urdf::Link& link, const std::string& source) {
  if (!link.inertial) {
    if (!link.visual_array.empty() || !link.collision_array.empty()) {
      Refuse(source, "link '" + link.name + "' has geometry but no <inertial>");
    }
    return std::nullopt;
  }
  const auto& from = *link.inertial;
  if (!(from.mass > 0) || !std::isfinite(from.mass)) {
    Refuse(source, "link '" + link.name + "' has a mass that is not positive");
  }
  const Pose X_LC = ToPose(from.origin);
  Eigen::Matrix3d I_C;
  I_C << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
  if (!Physical(I_C)) {
    Refuse(source, "link '" + link.name + "' has an inertia that no rigid body can have");
  }
  return UrdfInertial{from.mass, X_LC.p, X_LC.R * I_C * X_LC.R.transpose()};
}

/// The parser does not mind a link with two parents.
void CheckIsNew(const std::vector<UrdfLink>& links, const urdf::Link& link,
                const std::string& source) {
  for (const UrdfLink& known : links) {
    if (known.name != link.name) continue;
    Refuse(source, "link '" + link.name +
                       "' is the child of more than one joint: that closes a chain, and a robot "
                       "must be a tree");
  }
}

JointType ToType(const urdf::Joint& joint, const std::string& source) {
  switch (joint.type) {
    case urdf::Joint::FIXED:
      return JointType::kFixed;
    case urdf::Joint::REVOLUTE:
      return JointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    default:
      Refuse(source, "joint '" + joint.name + "' is not fixed, revolute, continuous or prismatic");
  }
}

UrdfJoint ReadJoint(const urdf::Joint& from, int parent, int child, const std::string& source) {
  UrdfJoint joint;
  joint.name = from.name;
  joint.type = ToType(from, source);
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ = ToPose(from.parent_to_joint_origin_transform);
  if (joint.type == JointType::kFixed) return joint;
  const Eigen::Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
  if (!(axis.norm() > 1e-6)) Refuse(source, "joint '" + from.name + "' has an axis of length zero");
  joint.axis = axis.normalized();
  if (!from.limits) return joint;
  joint.lower = from.limits->lower;
  joint.upper = from.limits->upper;
  joint.effort = from.limits->effort;
  if (joint.type != JointType::kContinuous && !(joint.lower < joint.upper)) {
    Refuse(source, "joint '" + from.name + "' has a lower limit, " + std::to_string(joint.lower) +
                       ", that is not below its upper one, " + std::to_string(joint.upper));
  }
  return joint;
}

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) Refuse(path, "can't read this URDF file");
  return text.str();
}

Pose Motion(const UrdfJoint& joint, double q) {
  switch (joint.type) {
    case JointType::kFixed:
      return {};
    case JointType::kPrismatic:
      return {Eigen::Matrix3d::Identity(), q * joint.axis};
    default:
      return {Eigen::AngleAxisd(q, joint.axis).toRotationMatrix(), Eigen::Vector3d::Zero()};
  }
}

}  // namespace

void UrdfInertial::Add(const UrdfInertial& body, const Pose& X_LB) {
  const Eigen::Vector3d p = X_LB * body.p_LC;
  const double sum_kg = mass_kg + body.mass_kg;
  const Eigen::Vector3d apart = p - p_LC;
  // Both about the common centre [Steiner]: together the reduced mass at their distance.
  const double reduced_kg = mass_kg * body.mass_kg / sum_kg;
  I_C_L +=
      X_LB.R * body.I_C_L * X_LB.R.transpose() +
      reduced_kg * (apart.squaredNorm() * Eigen::Matrix3d::Identity() - apart * apart.transpose());
  p_LC += body.mass_kg / sum_kg * apart;
  mass_kg = sum_kg;
}

UrdfRobot UrdfRobot::FromFile(const std::string& path) { return FromText(ReadText(path), path); }

UrdfRobot UrdfRobot::FromText(const std::string& xml, const std::string& source) {
  const auto model = Parse(xml, source);
  UrdfRobot robot;
  robot.name_ = model->getName();
  robot.source_ = source;
  const auto add = [&](const auto& self, const urdf::Link& link, int parent_joint) -> void {
    CheckGeometry(link, source);
    CheckIsNew(robot.links_, link, source);
    const int index = static_cast<int>(robot.links_.size());
    robot.links_.push_back({link.name, parent_joint, ReadInertial(link, source)});
    for (const auto& joint : link.child_joints) {
      const int child = static_cast<int>(robot.links_.size());
      robot.joints_.push_back(ReadJoint(*joint, index, child, source));
      self(self, *model->getLink(joint->child_link_name),
           static_cast<int>(robot.joints_.size()) - 1);
    }
  };
  add(add, *model->getRoot(), -1);
  return robot;
}

int UrdfRobot::LinkIndex(const std::string& name) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].name == name) return static_cast<int>(i);
  }
  Refuse(source_, "there is no link '" + name + "'");
}

int UrdfRobot::JointIndex(const std::string& name) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].name == name) return static_cast<int>(i);
  }
  Refuse(source_, "there is no joint '" + name + "'");
}

Pose UrdfRobot::LinkPose(int link, std::span<const double> joint_position) const {
  assert(link >= 0 && link < static_cast<int>(links_.size()));
  assert(joint_position.empty() || joint_position.size() == joints_.size());
  Pose X_BL;
  for (int i = links_[link].parent_joint; i >= 0; i = links_[joints_[i].parent].parent_joint) {
    const double q = joint_position.empty() ? 0.0 : joint_position[i];
    X_BL = joints_[i].X_PJ * Motion(joints_[i], q) * X_BL;
  }
  return X_BL;
}

double UrdfRobot::TotalMass() const {
  double mass = 0.0;
  for (const auto& link : links_) mass += link.inertial ? link.inertial->mass_kg : 0.0;
  return mass;
}

}  // namespace reckon::models
