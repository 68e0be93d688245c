#pragma once

#include <cmath>
#include <functional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reckon/models/pose.h"
#include "sim/body_in_water.h"

namespace reckon::testing_sim {

/// Kirchhoff's equations in axes forward-right-down and a world whose z points down, for the sum of
/// the momenta of body and water, without a Coriolis matrix: it shares no code and no axes with the
/// simulation.
///     Ṗ + ω × P = F,   Ḣ + ω × H + v × P_body + v_r × P_water = M
class Kirchhoff {
 public:
  using Vec3 = Eigen::Vector3d;

  Kirchhoff(const BodyInWater& body, std::function<Vector6(double)> thrust,
            std::function<WaterMotion(double)> water)
      : body_(body), thrust_(std::move(thrust)), water_(std::move(water)) {
    flip_ = Vec3(1, -1, -1).asDiagonal();
    Matrix6 both = Matrix6::Zero();
    both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = flip_;
    M_water_ = both * body.water.added_mass * both;
    p_BG_ = flip_ * body.p_BG_m;
    p_BV_ = flip_ * body.water.p_BV_m;
    const Eigen::Matrix3d S = Cross(p_BG_);
    M_body_.topLeftCorner<3, 3>() = body.mass_kg * Eigen::Matrix3d::Identity();
    M_body_.topRightCorner<3, 3>() = -body.mass_kg * S;
    M_body_.bottomLeftCorner<3, 3>() = body.mass_kg * S;
    M_body_.bottomRightCorner<3, 3>() =
        Eigen::Matrix3d(body.inertia_kg_m2.asDiagonal()) - body.mass_kg * S * S;
    inverse_ = (M_body_ + M_water_).inverse();
    momentum_ = -M_water_ * Carried(0.0, q_.toRotationMatrix());
  }

  /// From rest at the origin, to `end_s`.
  void Run(double end_s, double h) {
    const long steps = std::lround(end_s / h);
    for (long i = 0; i < steps; ++i) Step(static_cast<double>(i) * h, h);
  }

  /// In the simulator's axes: z up, B forward-left-up.
  models::Pose Pose() const { return {flip_ * q_.toRotationMatrix() * flip_, flip_ * p_}; }

 private:
  struct Slope {
    Vec3 p;
    Eigen::Vector4d q;  ///< x, y, z, w
    Vector6 momentum;
  };

  static Eigen::Matrix3d Cross(const Vec3& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  }

  Vector6 Carried(double t, const Eigen::Matrix3d& R) const {
    Vector6 v;
    v << R.transpose() * (flip_ * water_(t).velocity_m_s), Vec3::Zero();
    return v;
  }

  Slope At(double t, const Eigen::Quaterniond& q, const Vector6& total) const {
    const Eigen::Matrix3d R = q.normalized().toRotationMatrix();
    const Vector6 carried = Carried(t, R);
    const Vector6 twist = inverse_ * (total + M_water_ * carried);
    const Vector6 relative = twist - carried;
    const Vec3 w = twist.tail<3>(), v = twist.head<3>(), v_r = relative.head<3>();
    const Vec3 P_body = (M_body_ * twist).head<3>(), P_water = (M_water_ * relative).head<3>();
    const Vec3 down = R.transpose() * Vec3::UnitZ();
    const double weight = body_.mass_kg * kG;
    const double buoyancy = body_.density_kg_m3 * kG * body_.water.volume_m3;
    Vector6 force = thrust_(t);
    force.head<3>() = (flip_ * force.head<3>()).eval();
    force.tail<3>() = (flip_ * force.tail<3>()).eval();
    for (int i = 0; i < 6; ++i) {
      force[i] -= (body_.water.linear_damping[i] +
                   body_.water.quadratic_damping[i] * std::abs(relative[i])) *
                  relative[i];
    }
    force.head<3>() += (weight - buoyancy) * down;
    force.tail<3>() += p_BG_.cross(weight * down) - p_BV_.cross(buoyancy * down);
    Slope slope;
    slope.p = R * v;
    slope.q = 0.5 * (q * Eigen::Quaterniond(0, w.x(), w.y(), w.z())).coeffs();
    slope.momentum.head<3>() = force.head<3>() - w.cross(Vec3(total.head<3>()));
    slope.momentum.tail<3>() =
        force.tail<3>() - w.cross(Vec3(total.tail<3>())) - v.cross(P_body) - v_r.cross(P_water);
    return slope;
  }

  void Step(double t, double h) {
    const auto from = [&](const Slope& s, double dt) {
      return At(t + dt, Eigen::Quaterniond(q_.coeffs() + dt * s.q), momentum_ + dt * s.momentum);
    };
    const Slope a = At(t, q_, momentum_), b = from(a, h / 2), c = from(b, h / 2), d = from(c, h);
    p_ += h / 6 * (a.p + 2 * b.p + 2 * c.p + d.p);
    q_.coeffs() += h / 6 * (a.q + 2 * b.q + 2 * c.q + d.q);
    q_.normalize();
    momentum_ += h / 6 * (a.momentum + 2 * b.momentum + 2 * c.momentum + d.momentum);
  }

  BodyInWater body_;
  std::function<Vector6(double)> thrust_;
  std::function<WaterMotion(double)> water_;
  Eigen::Matrix3d flip_;
  Matrix6 M_body_, M_water_, inverse_;
  Vec3 p_BG_, p_BV_, p_ = Vec3::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  Vector6 momentum_ = Vector6::Zero();
};

}  // namespace reckon::testing_sim
