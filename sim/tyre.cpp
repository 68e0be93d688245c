#include "reckon/sim/tyre.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace reckon::sim {

WheelContact SmoothContact(const Terrain& terrain, const TyreParameters& tyre,
                           const WheelMotion& wheel) {
  const Eigen::Vector3d& c = wheel.centre;
  double x = c.x(), y = c.y();
  Ground ground = terrain.At(x, y);
  for (int i = 0; i < 4; ++i) {  // relaxed fixed point: the error shrinks to 1 % of the offset
    const double gain = 0.7 / (1.0 + ground.hx * ground.hx + ground.hy * ground.hy);
    const double above = c.z() - ground.h;
    x += gain * ((c.x() - x) + above * ground.hx);
    y += gain * ((c.y() - y) + above * ground.hy);
    ground = terrain.At(x, y);
  }
  WheelContact contact;
  contact.normal = Eigen::Vector3d(-ground.hx, -ground.hy, 1.0).normalized();
  const double height = (c - Eigen::Vector3d(x, y, ground.h)).dot(contact.normal);
  const double depth = tyre.radius_m - height;
  if (depth <= 0.0) return contact;
  contact.load_n =
      std::max(0.0, tyre.normal_stiffness_n_m * depth -
                        tyre.normal_damping_n_s_m * contact.normal.dot(wheel.velocity));
  contact.point = c - contact.normal * (tyre.radius_m - depth / 3.0);
  return contact;
}

TyreForce Tyre::Update(const TyreParameters& tyre, const WheelMotion& wheel,
                       const WheelContact& contact, double friction, double dt_s) {
  if (contact.load_n <= 0.0) {
    z_.setZero();
    return {};
  }
  const Eigen::Vector3d& n = contact.normal;
  const Eigen::Vector3d left = (wheel.axle - n * n.dot(wheel.axle)).normalized();
  const Eigen::Vector3d forward = left.cross(n);
  const Eigen::Vector3d velocity =
      wheel.velocity + wheel.angular_velocity.cross(contact.point - wheel.centre);
  const Eigen::Vector2d slip(forward.dot(velocity), left.dot(velocity));

  const double limit = friction * contact.load_n;
  z_ = (z_ + slip * dt_s) /
       (1.0 + std::abs(wheel.spin_rad_s) * tyre.radius_m * dt_s / tyre.relaxation_m);
  const double pull = tyre.stiffness_n_m * z_.norm();
  if (pull > limit) z_ *= limit / pull;
  Eigen::Vector2d f = -tyre.stiffness_n_m * z_ - tyre.damping_n_s_m * slip;
  const double size = f.norm();
  if (size > limit) f *= limit / size;

  return {
      forward * f.x() + left * f.y(),
      -tyre.rolling_resistance * contact.load_n * tyre.radius_m * std::tanh(wheel.spin_rad_s / 0.2),
      slip.norm()};
}

}  // namespace reckon::sim
