#include "reckon/sim/legged_body.h"

#include <set>
#include <stdexcept>

#include "reckon/models/contact_sample.h"

namespace reckon::sim {
namespace {

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw std::invalid_argument("drive: " + sentence);
}

std::vector<std::string> MovingJoints(const models::UrdfRobot& urdf, const std::string& foot) {
  std::vector<std::string> names;
  for (const int j : models::JointsTo(urdf, urdf.LinkIndex(foot))) {
    const models::UrdfJoint& joint = urdf.joints()[static_cast<std::size_t>(j)];
    if (joint.type != models::JointType::kFixed) names.push_back(joint.name);
  }
  return names;
}

void CheckLists(const LeggedConfig& config) {
  for (const auto& [key, list] : {std::pair{"armature_kg_m2", &config.armature_kg_m2},
                                  std::pair{"damping_n_m_s", &config.damping_n_m_s},
                                  std::pair{"friction_n_m", &config.friction_n_m},
                                  std::pair{"stand_angles_rad", &config.stand_angles_rad}}) {
    Require(list->size() == LeggedBody::kLegJoints,
            std::string(key) + " must have one entry for each of a leg's three joints, and has " +
                std::to_string(list->size()));
  }
}

}  // namespace

std::vector<std::string> LegJoints(const models::UrdfRobot& urdf,
                                   const std::vector<std::string>& feet) {
  std::vector<std::string> joints;
  std::set<std::string> seen;
  for (const std::string& foot : feet) {
    const auto own = MovingJoints(urdf, foot);
    Require(!own.empty(), "the foot '" + foot + "' hangs on no moving joint");
    for (const std::string& joint : own) {
      Require(seen.insert(joint).second,
              "the joint '" + joint + "' moves more than one foot: legs must not share joints");
      joints.push_back(joint);
    }
  }
  return joints;
}

LeggedBody::LeggedBody(const models::UrdfRobot& urdf, const LeggedConfig& config)
    : foot_radius_m_(config.foot_radius_m) {
  Require(!config.feet.empty() && config.feet.size() <= models::kMaxFeet,
          "feet must name 1 to " + std::to_string(models::kMaxFeet) + " links of the URDF");
  CheckLists(config);
  joints_ = LegJoints(urdf, config.feet);
  const auto count = static_cast<Eigen::Index>(joints_.size());
  Require(count == kLegJoints * static_cast<Eigen::Index>(config.feet.size()) &&
              count <= models::kMaxEncoders,
          "the walking controller needs legs of three joints each");
  stand_angles_rad_.resize(count);
  torque_limit_n_m_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const models::UrdfJoint& joint = urdf.joints()[urdf.JointIndex(joints_[i])];
    Require(joint.type != models::JointType::kPrismatic,
            "the walking controller needs turning joints, and '" + joint.name + "' slides");
    Require(joint.effort > 0.0, "the joint '" + joint.name + "' needs a <limit effort> above 0");
    torque_limit_n_m_[i] = joint.effort;
    stand_angles_rad_[i] = config.stand_angles_rad[static_cast<std::size_t>(i % kLegJoints)];
  }
  double lowest = 0.0;
  for (const std::string& foot : config.feet) {
    kinematics_.emplace_back(urdf, foot, joints_);
    Require(kinematics_.back().entries().size() == kLegJoints,
            "the walking controller needs legs of three joints, and that of '" + foot + "' has " +
                std::to_string(kinematics_.back().entries().size()));
    dynamics_.emplace_back(urdf, foot, joints_, config.armature_kg_m2);
    stand_foot_.push_back(kinematics_.back().Evaluate(stand_angles_rad_).p_BF);
    lowest += stand_foot_.back().z() / static_cast<double>(config.feet.size());
  }
  stand_height_m_ = foot_radius_m_ - lowest;
  Require(stand_height_m_ > 2.0 * foot_radius_m_,
          "stand_angles_rad must put the feet below the body");
  WeighStanding(urdf);
}

void LeggedBody::WeighStanding(const models::UrdfRobot& urdf) {
  std::vector<double> q(urdf.joints().size(), 0.0);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    q[urdf.JointIndex(joints_[i])] = stand_angles_rad_[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t i = 0; i < urdf.links().size(); ++i) {
    const auto& inertial = urdf.links()[i].inertial;
    if (inertial) whole_.Add(*inertial, urdf.LinkPose(static_cast<int>(i), q));
  }
}

}  // namespace reckon::sim
