#include "reckon/sim/submerged_body.h"

#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace reckon::sim {
namespace {

using ConstVec3 = Eigen::Map<const Eigen::Vector3d>;

Vector6 TwistIn(const Eigen::Matrix3d& R, const double* v) {
  Vector6 twist;
  twist << R.transpose() * ConstVec3(v), ConstVec3(v + 3);
  return twist;
}

}  // namespace

SubmergedBody::SubmergedBody(const mjModel& model, int body) : joint_(model, body) {
  const std::string name = mj_id2name(&model, mjOBJ_BODY, body);
  for (int i = 0; i < 6; ++i) {
    if (model.M_rownnz[joint_.twist_address + i] != i + 1) {
      throw std::invalid_argument("body '" + name +
                                  "': its inertia is stored diagonally; move its centre of mass a "
                                  "little off the frame's origin");
    }
  }
  if (model.opt.solver == mjSOL_PGS) {
    throw std::invalid_argument("added mass needs the Newton or the CG solver");
  }
}

Vector6 SubmergedBody::Twist(const mjData& data) const {
  return TwistIn(Pose(data).R, data.qvel + joint_.twist_address);
}

void SubmergedBody::Apply(const Matrix6& added_mass, const Vector6& wrench, const mjModel& model,
                          mjData& data) const {
  const Eigen::Matrix3d R = Pose(data).R;
  const Vector6 twist = TwistIn(R, data.qvel + joint_.twist_address);
  Matrix6 turned = added_mass;
  turned.topRows<3>() = (R * turned.topRows<3>()).eval();
  turned.leftCols<3>() = (turned.leftCols<3>() * R.transpose()).eval();
  for (int i = 0; i < 6; ++i) {
    double* row = data.M + model.M_rowadr[joint_.twist_address + i];
    for (int j = 0; j <= i; ++j) row[j] += turned(i, j);
  }
  mj_factorM(&model, &data);

  Vector6 carried = Vector6::Zero();
  carried.head<3>() = twist.tail<3>().cross(twist.head<3>());
  Vector6 force = wrench + added_mass * carried;
  force.head<3>() = (R * force.head<3>()).eval();
  Eigen::Map<Vector6>(data.qfrc_applied + joint_.twist_address) = force;
}

}  // namespace reckon::sim
