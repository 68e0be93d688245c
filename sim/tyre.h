#pragma once

#include <Eigen/Core>

#include "reckon/sim/terrain.h"

namespace reckon::sim {

struct TyreParameters {
  double radius_m = 0.0;
  double stiffness_n_m = 0.0, damping_n_s_m = 0.0;  ///< tangential: bristle spring and damper
  double relaxation_m = 0.0;                        ///< rolling this far forgets the bristle
  double normal_stiffness_n_m = 0.0, normal_damping_n_s_m = 0.0;
  double rolling_resistance = 0.0;
};

/// How a wheel moves. All vectors in W.
struct WheelMotion {
  Eigen::Vector3d centre, velocity;        ///< of the wheel's centre
  Eigen::Vector3d angular_velocity, axle;  ///< of the wheel as a body; unit axis of its spin
  double spin_rad_s = 0.0;                 ///< about the axle, relative to the chassis
};

/// Where a wheel presses on the ground: unit normal (out of the ground), point, load ≥ 0. In W.
struct WheelContact {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(), point = Eigen::Vector3d::Zero();
  double load_n = 0.0;
};

/// Contact of a wheel (as a sphere of its radius) with smooth ground. With n the ground's normal at
/// the closest point and δ the depth along it,
///     N = max(0, k_n δ − c_n n·v),   p = c − n (R − δ/3):
/// a compressed wheel rolls on the radius R − δ/3.
WheelContact SmoothContact(const Terrain& terrain, const TyreParameters& tyre,
                           const WheelMotion& wheel);

/// What the ground does to a wheel besides pressing: a tangential force at the contact point [N,
/// W], and the rolling resistance about the axle [N m].
struct TyreForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double spin_torque_n_m = 0.0;
  double slip_m_s = 0.0;  ///< speed of the contact point over the ground; 0 in the air
};

/// The friction of one wheel: a bristle z [m] in the contact's tangent plane that is dragged by the
/// slip velocity s, forgotten by rolling, and limited to Coulomb's cone:
///     z ← (z + s dt) / (1 + |ω| R dt/σ),   |k z| ≤ μN,   F = −k z − c s,   |F| ≤ μN.
/// At rest it is a spring, so a parked wheel doesn't creep; in a slide it is Coulomb friction.
/// Rolling resistance: −c_rr N R tanh(ω / 0.2 rad/s). The bristle is state: a snapshot holds it.
class Tyre {
 public:
  TyreForce Update(const TyreParameters& tyre, const WheelMotion& wheel,
                   const WheelContact& contact, double friction, double dt_s);

  const Eigen::Vector2d& bristle() const { return z_; }

 private:
  Eigen::Vector2d z_ = Eigen::Vector2d::Zero();  // forward, left
};

}  // namespace reckon::sim
