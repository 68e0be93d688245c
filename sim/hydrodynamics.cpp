#include "reckon/sim/hydrodynamics.h"

#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

void Require(bool holds, const std::string& name, const std::string& what) {
  if (!holds) throw std::invalid_argument(name + ": " + what);
}

const HydrodynamicsConfig& Checked(const std::string& name, const HydrodynamicsConfig& c) {
  Require(std::isfinite(c.volume_m3) && c.volume_m3 >= 0.0, name, "volume_m3 must not be negative");
  Require(c.p_BV_m.allFinite(), name, "the centre of buoyancy must be finite");
  Require(c.linear_damping.allFinite() && c.linear_damping.minCoeff() >= 0.0, name,
          "linear_damping must not be negative");
  Require(c.quadratic_damping.allFinite() && c.quadratic_damping.minCoeff() >= 0.0, name,
          "quadratic_damping must not be negative");
  const Matrix6& M = c.added_mass;
  Require(M.allFinite(), name, "added_mass must be finite");
  const double scale = M.cwiseAbs().maxCoeff();
  Require((M - M.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale, name,
          "added_mass must be symmetric");
  // Round-off apart: a body without added inertia about an axis has a zero there.
  Require(Eigen::SelfAdjointEigenSolver<Matrix6>(M).eigenvalues().minCoeff() >= -1e-12 * scale,
          name, "added_mass must have no negative eigenvalue");
  return c;
}

}  // namespace

Hydrodynamics::Hydrodynamics(const std::string& name, const HydrodynamicsConfig& config,
                             double density_kg_m3, double gravity_m_s2)
    : config_(Checked(name, config)), buoyancy_n_(density_kg_m3 * gravity_m_s2 * config.volume_m3) {
  Require(std::isfinite(density_kg_m3) && density_kg_m3 > 0.0, name,
          "the water's density must be positive");
}

Vector6 Hydrodynamics::Wrench(const Eigen::Matrix3d& R, const Vector6& twist,
                              const WaterMotion& water) const {
  const Vector3d w = twist.tail<3>();
  const Vector3d current = R.transpose() * water.velocity_m_s;
  Vector6 relative = twist;
  relative.head<3>() -= current;
  Vector6 carried = Vector6::Zero();  // how the current's velocity changes in B
  carried.head<3>() = R.transpose() * water.acceleration_m_s2 - w.cross(current);

  const Vector6 momentum = config_.added_mass * relative;
  const Vector3d p = momentum.head<3>(), h = momentum.tail<3>(), v = relative.head<3>();
  Vector6 coriolis;
  coriolis << w.cross(p), w.cross(h) + v.cross(p);

  const Vector3d up = R.transpose() * Vector3d(0.0, 0.0, buoyancy_n_);
  Vector6 buoyancy;
  buoyancy << up, config_.p_BV_m.cross(up);
  const Vector6 damping =
      config_.linear_damping.cwiseProduct(relative) +
      config_.quadratic_damping.cwiseProduct(relative.cwiseAbs()).cwiseProduct(relative);
  return config_.added_mass * carried - coriolis - damping + buoyancy;
}

}  // namespace reckon::sim
