#include "reckon/sim/submerged_body.h"

#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using ConstVec3 = Eigen::Map<const Vector3d>;

}  // namespace

SubmergedBody::SubmergedBody(const mjModel& model, int body) {
  const std::string name = mj_id2name(&model, mjOBJ_BODY, body);
  const int joint = model.body_jntadr[body];
  if (joint < 0 || model.jnt_type[joint] != mjJNT_FREE) {
    throw std::invalid_argument("body '" + name + "' has no free joint");
  }
  pose_address_ = model.jnt_qposadr[joint];
  twist_address_ = model.jnt_dofadr[joint];
  for (int i = 0; i < 6; ++i) {
    if (model.M_rownnz[twist_address_ + i] != i + 1) {
      throw std::invalid_argument("body '" + name +
                                  "': its inertia is stored diagonally; move its centre of mass a "
                                  "little off the frame's origin");
    }
  }
  if (model.opt.solver == mjSOL_PGS) {
    throw std::invalid_argument("added mass needs the Newton or the CG solver");
  }
}

models::Pose SubmergedBody::Pose(const mjData& data) const {
  const double* q = data.qpos + pose_address_;
  return {Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix(), ConstVec3(q)};
}

Vector6 SubmergedBody::Twist(const mjData& data) const {
  const double* v = data.qvel + twist_address_;
  Vector6 twist;
  twist << Pose(data).R.transpose() * ConstVec3(v), ConstVec3(v + 3);
  return twist;
}

void SubmergedBody::Apply(const Matrix6& added_mass, const Vector6& wrench, const mjModel& model,
                          mjData& data) const {
  const Eigen::Matrix3d R = Pose(data).R;
  const Vector6 twist = Twist(data);
  Matrix6 turned = added_mass;
  turned.topRows<3>() = (R * turned.topRows<3>()).eval();
  turned.leftCols<3>() = (turned.leftCols<3>() * R.transpose()).eval();
  for (int i = 0; i < 6; ++i) {
    double* row = data.M + model.M_rowadr[twist_address_ + i];
    for (int j = 0; j <= i; ++j) row[j] += turned(i, j);
  }
  mj_factorM(&model, &data);

  Vector6 carried = Vector6::Zero();
  carried.head<3>() = twist.tail<3>().cross(twist.head<3>());
  Vector6 force = wrench + added_mass * carried;
  force.head<3>() = (R * force.head<3>()).eval();
  Eigen::Map<Vector6>(data.qfrc_applied + twist_address_) = force;
}

}  // namespace reckon::sim
