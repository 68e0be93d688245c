#include "reckon/models/leg_kinematics.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace reckon::models {
namespace {

int EntryOf(const std::string& joint, const std::string& foot,
            std::span<const std::string> encoders) {
  const auto found = std::find(encoders.begin(), encoders.end(), joint);
  if (found == encoders.end()) {
    throw std::invalid_argument("the leg of '" + foot + "' has a joint without an encoder: '" +
                                joint + "'");
  }
  return static_cast<int>(found - encoders.begin());
}

}  // namespace

std::vector<int> JointsTo(const UrdfRobot& robot, int link) {
  std::vector<int> joints;
  for (int j = robot.links()[link].parent_joint; j >= 0;
       j = robot.links()[robot.joints()[j].parent].parent_joint) {
    joints.push_back(j);
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

LegKinematics::LegKinematics(const UrdfRobot& robot, const std::string& foot,
                             std::span<const std::string> encoders)
    : foot_(foot) {
  Pose X_PJ;  // since the last moving joint
  for (const int j : JointsTo(robot, robot.LinkIndex(foot))) {
    const UrdfJoint& joint = robot.joints()[j];
    X_PJ = X_PJ * joint.X_PJ;
    if (joint.type == JointType::kFixed) continue;
    const bool turns = joint.type != JointType::kPrismatic;
    chain_.push_back({X_PJ, joint.axis, turns, EntryOf(joint.name, foot, encoders)});
    entries_.push_back(chain_.back().entry);
    X_PJ = {};
  }
  X_last_F_ = X_PJ;
  if (chain_.empty() || chain_.size() > kMaxLegJoints) {
    throw std::invalid_argument("the foot '" + foot + "' hangs on " +
                                std::to_string(chain_.size()) + " moving joints, expected 1 to " +
                                std::to_string(kMaxLegJoints));
  }
}

FootPosition LegKinematics::Evaluate(const EncoderVector& angles) const {
  std::array<Eigen::Vector3d, kMaxLegJoints> axis, origin;  // in the body
  Pose X;
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Link& link = chain_[k];
    assert(link.entry < angles.size());
    const double q = angles[link.entry];
    X = X * link.X_PJ;
    axis[k] = X.R * link.axis;
    origin[k] = X.p;
    if (link.turns) {
      X.R = X.R * Eigen::AngleAxisd(q, link.axis).toRotationMatrix();
    } else {
      X.p += q * axis[k];
    }
  }
  FootPosition foot;
  foot.p_BF = X * X_last_F_.p;
  const auto joints = static_cast<Eigen::Index>(chain_.size());
  foot.J.resize(3, joints);
  foot.A.setZero(3, joints);
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    foot.J.col(column) = chain_[k].turns ? axis[k].cross(foot.p_BF - origin[k]).eval() : axis[k];
    if (chain_[k].turns) foot.A.col(column) = axis[k];
  }
  return foot;
}

}  // namespace reckon::models
