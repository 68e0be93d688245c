#include "reckon/models/leg_dynamics.h"

#include <array>
#include <cassert>
#include <stdexcept>

namespace reckon::models {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Takes `link`, which lies at X in a moving link, into its mass, and all that is fixed to it.
void AddFixedLinks(const UrdfRobot& robot, int link, const Pose& X, UrdfInertial& moving) {
  const UrdfLink& body = robot.links()[static_cast<std::size_t>(link)];
  if (body.inertial) moving.Add(*body.inertial, X);
  for (const UrdfJoint& joint : robot.joints()) {
    if (joint.parent != link || joint.type != JointType::kFixed) continue;
    AddFixedLinks(robot, joint.child, X * joint.X_PJ, moving);
  }
}

}  // namespace

LegDynamics::LegDynamics(const UrdfRobot& robot, const std::string& foot,
                         std::span<const std::string> encoders, std::span<const double> armature) {
  const LegKinematics kinematics(robot, foot, encoders);  // checks the chain
  Pose X_PJ;                                              // since the last moving joint
  for (const int j : JointsTo(robot, robot.LinkIndex(foot))) {
    const UrdfJoint& joint = robot.joints()[static_cast<std::size_t>(j)];
    X_PJ = X_PJ * joint.X_PJ;
    if (joint.type == JointType::kFixed) continue;
    Link link{X_PJ, joint.axis, joint.type != JointType::kPrismatic};
    AddFixedLinks(robot, joint.child, {}, link.mass);
    chain_.push_back(link);
    X_PJ = {};
  }
  if (armature.size() != chain_.size()) {
    throw std::invalid_argument("the leg of '" + foot + "' has " + std::to_string(chain_.size()) +
                                " moving joints, but " + std::to_string(armature.size()) +
                                " armatures are given");
  }
  for (std::size_t k = 0; k < chain_.size(); ++k) chain_[k].armature_kg_m2 = armature[k];
}

LegVector LegDynamics::InverseDynamics(const LegVector& q, const LegVector& dq,
                                       const LegVector& ddq, const BodyMotion& body) const {
  assert(q.size() == joints() && dq.size() == joints() && ddq.size() == joints());
  std::array<Matrix3d, kMaxLegJoints> R;        // from a link to its parent
  std::array<Vector3d, kMaxLegJoints> p, f, n;  // joint's origin in the parent; force, moment
  Vector3d w = body.w_rad_s, dw = body.dw_rad_s2, a = body.specific_force_m_s2;
  const std::size_t count = chain_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Link& link = chain_[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double angle = link.turns ? q[i] : 0.0;
    R[k] = link.X_PJ.R * Eigen::AngleAxisd(angle, link.axis).toRotationMatrix();
    const Vector3d slide = link.turns ? Vector3d::Zero() : (q[i] * link.axis).eval();
    p[k] = link.X_PJ.p + link.X_PJ.R * slide;
    const Matrix3d R_CP = R[k].transpose();
    a = R_CP * (a + dw.cross(p[k]) + w.cross(w.cross(p[k])));
    w = R_CP * w;
    dw = R_CP * dw;
    if (link.turns) {
      dw += w.cross(dq[i] * link.axis) + ddq[i] * link.axis;
      w += dq[i] * link.axis;
    } else {
      a += 2.0 * w.cross(dq[i] * link.axis) + ddq[i] * link.axis;
    }
    const Vector3d a_C = a + dw.cross(link.mass.p_LC) + w.cross(w.cross(link.mass.p_LC));
    f[k] = link.mass.mass_kg * a_C;
    n[k] = link.mass.I_C_L * dw + w.cross(link.mass.I_C_L * w) + link.mass.p_LC.cross(f[k]);
  }
  LegVector torque(q.size());
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();  // on the next link, in this one
  for (std::size_t k = count; k-- > 0;) {
    const Link& link = chain_[k];
    const auto i = static_cast<Eigen::Index>(k);
    force += f[k];
    moment += n[k];
    torque[i] = link.axis.dot(link.turns ? moment : force) + link.armature_kg_m2 * ddq[i];
    force = (R[k] * force).eval();
    moment = R[k] * moment + p[k].cross(force);
  }
  return torque;
}

LegVector LegDynamics::GravityTorque(const LegVector& q, const Vector3d& up_B,
                                     double gravity_m_s2) const {
  const LegVector zero = LegVector::Zero(q.size());
  BodyMotion still;
  still.specific_force_m_s2 = gravity_m_s2 * up_B;
  return InverseDynamics(q, zero, zero, still);
}

LegDynamics::Matrix LegDynamics::MassMatrix(const LegVector& q) const {
  const LegVector zero = LegVector::Zero(q.size());
  Matrix M(q.size(), q.size());
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    M.col(k) = InverseDynamics(q, zero, LegVector::Unit(q.size(), k), {});
  }
  return M;
}

}  // namespace reckon::models
