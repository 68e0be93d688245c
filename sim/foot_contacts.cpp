#include "reckon/sim/foot_contacts.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using ConstVec3 = Eigen::Map<const Vector3d>;

Vector3d Point(const double* array, int index) {
  return ConstVec3(array + static_cast<std::ptrdiff_t>(3 * index));
}

/// Angular and linear velocity in W of a geom's middle.
struct Velocity {
  Vector3d w, v;
};

Velocity VelocityOf(const mjModel& model, const mjData& data, int geom) {
  double velocity[6];
  mj_objectVelocity(&model, &data, mjOBJ_GEOM, geom, velocity, 0);
  return {Vector3d(velocity), Vector3d(velocity + 3)};
}

}  // namespace

FootContacts::FootContacts(const mjModel& model, const std::vector<std::string>& feet)
    : count_(static_cast<int>(feet.size())) {
  for (int i = 0; i < count_; ++i) {
    geom_[i] = mj_name2id(&model, mjOBJ_GEOM, FootGeom(feet[i]).c_str());
  }
}

void FootContacts::SetFriction(const Terrain& terrain, const mjData& data, mjModel& model) const {
  for (int i = 0; i < count_; ++i) {
    const Vector3d p = Point(data.geom_xpos, geom_[i]);
    model.geom_friction[static_cast<std::ptrdiff_t>(3 * geom_[i])] =
        std::max(mjMINMU, terrain.Friction(p.x(), p.y()));
  }
}

ground_truth::FeetTruth FootContacts::Read(const mjModel& model, const mjData& data) const {
  ground_truth::FeetTruth feet;
  feet.count = count_;
  std::array<Velocity, models::kMaxFeet> velocity;
  std::array<Vector3d, models::kMaxFeet> tangential;
  tangential.fill(Vector3d::Zero());
  for (int i = 0; i < count_; ++i) {
    velocity[i] = VelocityOf(model, data, geom_[i]);
    feet.foot[i].centre_m_s = velocity[i].v.norm();
  }
  for (int c = 0; c < data.ncon; ++c) {
    const mjContact& contact = data.contact[c];
    for (int i = 0; i < count_; ++i) {
      if (contact.geom[0] != geom_[i] && contact.geom[1] != geom_[i]) continue;
      double force[6];
      mj_contactForce(&model, &data, c, force);
      const double sign =
          contact.geom[1] == geom_[i] ? 1.0 : -1.0;  // the frame's x: first to second
      const Vector3d normal = sign * ConstVec3(contact.frame);
      const Vector3d r = ConstVec3(contact.pos) - Point(data.geom_xpos, geom_[i]);
      const Vector3d v = velocity[i].v + velocity[i].w.cross(r);
      feet.foot[i].normal_n += force[0];
      feet.foot[i].normal += force[0] * normal;
      feet.foot[i].slip_m_s += force[0] * (v - normal * normal.dot(v)).norm();
      tangential[i] +=
          force[1] * ConstVec3(contact.frame + 3) + force[2] * ConstVec3(contact.frame + 6);
    }
  }
  for (int i = 0; i < count_; ++i) {
    ground_truth::FootTruth& foot = feet.foot[i];
    foot.contact = foot.normal_n > ground_truth::FootTruth::kContactForce;
    foot.tangential_n = tangential[i].norm();
    foot.slip_m_s = foot.normal_n > 0.0 ? foot.slip_m_s / foot.normal_n : 0.0;
    if (foot.normal_n > 0.0) foot.normal.normalize();
  }
  return feet;
}

bool FootContacts::TrunkTouches(const mjModel& model, const mjData& data) {
  const auto of_trunk = [&model](int geom) {
    const int body = model.geom_bodyid[geom];
    return body != 0 && model.body_parentid[body] == 0;
  };
  for (int c = 0; c < data.ncon; ++c) {
    const mjContact& contact = data.contact[c];
    if (of_trunk(contact.geom[0]) || of_trunk(contact.geom[1])) return true;
  }
  return false;
}

}  // namespace reckon::sim
