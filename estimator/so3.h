#pragma once

#include <Eigen/Core>
#include <array>

namespace reckon::estimator {

/// [v]×: the matrix with Skew(v) w = v × w.
inline Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// What every function below shares at one φ: f_m(|φ|²) = Σ_k (−|φ|²)^k / (2k + m)!, m = 0 … 6.
/// Evaluated once, all that a propagation needs of φ follows. Does not allocate.
class RotationSeries {
 public:
  explicit RotationSeries(const Eigen::Vector3d& phi);

  /// Γ_m(φ), m = 0 … 3.
  Eigen::Matrix3d Gamma(int m) const;

  /// ∂(Γ_m(φ) a)/∂φ, m = 1, 2: a 3×3 matrix.
  Eigen::Matrix3d GammaDerivative(int m, const Eigen::Vector3d& a) const;

  /// J⁻¹(φ) of the left Jacobian J = Γ1.
  Eigen::Matrix3d LeftJacobianInverse() const;

 private:
  Eigen::Vector3d phi_;
  std::array<double, 7> f_;
};

/// Γ_m(φ) = Σ_n [φ]×ⁿ / (n + m)!  for m = 0 … 3 [Hartley20, eq. 30 ff.]. Γ0 is the exponential of
/// SO(3), Γ1 its left Jacobian. Of φ in rad; exact to round-off for every |φ| below π, and
/// continuous to 1e-13 where the series hands over to sines. Does not allocate.
inline Eigen::Matrix3d Gamma(int m, const Eigen::Vector3d& phi) {
  return RotationSeries(phi).Gamma(m);
}

/// Exp(φ) = Γ0(φ): the rotation by |φ| about φ.
inline Eigen::Matrix3d Exp(const Eigen::Vector3d& phi) { return Gamma(0, phi); }

/// The φ with Exp(φ) = R and |φ| ≤ π. Exact near the identity and near π.
Eigen::Vector3d Log(const Eigen::Matrix3d& R);

/// J(φ) = Γ1(φ), with Exp(φ + δ) ≈ Exp(J(φ) δ) Exp(φ).
inline Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& phi) { return Gamma(1, phi); }

/// J⁻¹(φ) for |φ| < 2π.
inline Eigen::Matrix3d LeftJacobianInverse(const Eigen::Vector3d& phi) {
  return RotationSeries(phi).LeftJacobianInverse();
}

}  // namespace reckon::estimator
