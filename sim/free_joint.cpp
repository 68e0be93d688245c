#include "reckon/sim/free_joint.h"

#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace reckon::sim {

using Vec3 = Eigen::Map<Eigen::Vector3d>;

FreeJoint::FreeJoint(const mjModel& model, int body) {
  const int joint = model.body_jntadr[body];
  if (joint < 0 || model.jnt_type[joint] != mjJNT_FREE) {
    throw std::invalid_argument("body '" + std::string(mj_id2name(&model, mjOBJ_BODY, body)) +
                                "' has no free joint");
  }
  pose_address = model.jnt_qposadr[joint];
  twist_address = model.jnt_dofadr[joint];
}

models::Pose FreeJoint::Pose(const mjData& data) const {
  const double* q = data.qpos + pose_address;
  return {Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix(),
          {q[0], q[1], q[2]}};
}

void FreeJoint::Place(const models::Pose& X_WB, mjData& data) const {
  double* pose = data.qpos + pose_address;
  const Eigen::Quaterniond q(X_WB.R);
  Vec3{pose} = X_WB.p;
  pose[3] = q.w();
  Vec3{pose + 4} = q.vec();
}

}  // namespace reckon::sim
