#pragma once

#include <string>

#include <Eigen/Core>

namespace reckon::sim {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What water does to a submerged body, about the origin of B and in its axes (x forward, y left,
/// z up), linear before angular. Coefficients that are published for axes forward-right-down keep
/// their values on the diagonal; the others turn with diag(1, −1, −1).
struct HydrodynamicsConfig {
  double volume_m3 = 0.0;                            ///< displaced when submerged
  Eigen::Vector3d p_BV_m = Eigen::Vector3d::Zero();  ///< centre of buoyancy
  Matrix6 added_mass = Matrix6::Zero();              ///< M_A [kg, kg m, kg m²]
  Vector6 linear_damping = Vector6::Zero();          ///< D_l [N s/m, N m s]
  Vector6 quadratic_damping = Vector6::Zero();       ///< D_q [N s²/m², N m s²]
};

/// The water around a body: its velocity in W and how that changes.
struct WaterMotion {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
};

/// Forces of the water on a body [Fossen 2011, ch. 6 and 8], with ν_r = ν − [Rᵀ v_c; 0] the
/// velocity relative to an irrotational current v_c.
class Hydrodynamics {
 public:
  /// Throws std::invalid_argument, which begins with `name` and names the
  /// key: an added mass that is not symmetric or has a negative eigenvalue, a damping or volume
  /// that is negative, numbers that are not finite.
  Hydrodynamics(const std::string& name, const HydrodynamicsConfig& config, double density_kg_m3,
                double gravity_m_s2);

  const Matrix6& added_mass() const { return config_.added_mass; }

  /// The wrench about the origin of B in its axes, all but −M_A ν̇:
  ///     M_A [−ω × Rᵀv_c + Rᵀv̇_c; 0] − C_A(ν_r) ν_r − D_l ν_r − D_q |ν_r| ν_r + [f_b; r_B × f_b],
  /// f_b = Rᵀ (0, 0, ρgV). With added momenta (p, h) = M_A ν_r Kirchhoff's
  /// C_A(ν_r) ν_r = [ω × p; ω × h + v_r × p]. `R` takes B to W; `twist` is ν = (v, ω) in B.
  /// Does not allocate.
  Vector6 Wrench(const Eigen::Matrix3d& R, const Vector6& twist, const WaterMotion& water) const;

 private:
  HydrodynamicsConfig config_;
  double buoyancy_n_;  ///< ρ g V
};

}  // namespace reckon::sim
