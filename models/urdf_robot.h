#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reckon/models/pose.h"

namespace reckon::models {

enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic };

/// The mass of a link: centre of mass C in the link's frame L [m], inertia about C in the axes of L
/// (the rotation of the URDF's inertial frame is applied) [kg m²].
struct UrdfInertial {
  double mass_kg = 0.0;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();
  Eigen::Matrix3d I_C_L = Eigen::Matrix3d::Zero();

  /// Adds the mass of another link at X_LB, as if it were fixed to this one.
  void Add(const UrdfInertial& body, const Pose& X_LB);
};

/// A rigid link; `inertial` is absent for pure frames (sensors).
struct UrdfLink {
  std::string name;
  int parent_joint = -1;  ///< index into joints(); -1 for the root
  std::optional<UrdfInertial> inertial;
};

/// A joint from parent link P to child link C: X_PC(q) = X_PJ · motion(axis, q).
struct UrdfJoint {
  std::string name;
  JointType type = JointType::kFixed;
  int parent = -1, child = -1;  ///< indices into links()
  Pose X_PJ;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit vector in the child's frame
  double lower = 0.0, upper = 0.0;                  ///< of a revolute [rad] or prismatic [m] joint
  double effort = 0.0;  ///< most that its motor gives [N m, N]; 0: not told
};

/// A robot as its URDF describes it: the tree of links and joints, root first, every parent before
/// its children. The root's frame is the body frame B.
class UrdfRobot {
 public:
  /// Reads a file, or its text. Throws std::invalid_argument with a sentence that names the file
  /// (or `source`) and the link or joint at fault: unreadable or ill-formed text, a link with
  /// geometry but without <inertial>, a mass or size that is not positive, an inertia no body can
  /// have, a joint type other than those above, limits whose lower end is not below the upper one,
  /// a chain of joints that closes.
  static UrdfRobot FromFile(const std::string& path);
  static UrdfRobot FromText(const std::string& xml, const std::string& source = "URDF");

  const std::string& name() const { return name_; }
  const std::vector<UrdfLink>& links() const { return links_; }
  const std::vector<UrdfJoint>& joints() const { return joints_; }

  /// The index of the link or joint called `name`; throws std::invalid_argument, which names it.
  int LinkIndex(const std::string& name) const;
  int JointIndex(const std::string& name) const;

  /// Pose X_BL of a link in the body. `joint_position` holds one entry per joints() (rad or m;
  /// those of fixed joints are ignored); empty means all zero.
  Pose LinkPose(int link, std::span<const double> joint_position = {}) const;
  Pose LinkPose(const std::string& link) const { return LinkPose(LinkIndex(link)); }

  /// Sum over all links [kg].
  double TotalMass() const;

 private:
  std::string name_, source_;
  std::vector<UrdfLink> links_;
  std::vector<UrdfJoint> joints_;
};

}  // namespace reckon::models
