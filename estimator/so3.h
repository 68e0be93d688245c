#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/estimator/lane_matrix.h"

namespace reckon::estimator {

/// [v]×: the matrix with Skew(v) w = v × w.
inline Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// What every function below shares at one φ: f_m(|φ|²) = Σ_k (−|φ|²)^k / (2k + m)!, m = 0 …
/// `kHighest`. Evaluated once, all that a propagation needs of φ follows; `kHighest` = 3 suffices
/// for Γ0 and Γ1. Does not allocate.
template <int kHighest = 6>
class RotationSeries {
 public:
  explicit RotationSeries(const Eigen::Vector3d& phi) : RotationSeries(ToLane(phi)) {}
  explicit RotationSeries(Lane phi);

  /// Γ_m(φ) = f_m I + f_{m+1} [φ]× + f_{m+2} φ φᵀ.
  LaneMatrix GammaInLanes(int m) const {
    return DiagonalAndCross(f_[m], f_[m + 1] * phi_) + Outer(f_[m + 2] * phi_, phi_);
  }
  Eigen::Matrix3d Gamma(int m) const { return ToEigen(GammaInLanes(m)); }

  /// ∂(Γ_m(φ) a)/∂φ, m = 1, 2: a 3×3 matrix.
  LaneMatrix GammaDerivative(int m, Lane a) const;
  Eigen::Matrix3d GammaDerivative(int m, const Eigen::Vector3d& a) const {
    return ToEigen(GammaDerivative(m, ToLane(a)));
  }

  /// J⁻¹(φ) of the left Jacobian J = Γ1.
  Eigen::Matrix3d LeftJacobianInverse() const;

 private:
  Lane phi_;
  std::array<double, kHighest + 1> f_;
};

template <int kHighest>
inline LaneMatrix RotationSeries<kHighest>::GammaDerivative(int m, Lane a) const {
  static_assert(kHighest >= 6);
  // f_m'(x) = (m f_{m+2} − f_{m+1}) / 2.
  const auto twice_slope = [this](int n) { return n * f_[n + 2] - f_[n + 1]; };
  const Lane once = Cross(phi_, a);
  const Lane twice = Cross(phi_, once);
  // [φ]× [a]× = a φᵀ − (φ·a) I and [φ × a]× = a φᵀ − φ aᵀ.
  const Lane left = twice_slope(m + 1) * once + twice_slope(m + 2) * twice - 2.0 * f_[m + 2] * a;
  return DiagonalAndCross(f_[m + 2] * Dot(phi_, a), -f_[m + 1] * a) + Outer(left, phi_) +
         Outer(f_[m + 2] * phi_, a);
}

extern template RotationSeries<3>::RotationSeries(Lane phi);
extern template class RotationSeries<6>;

/// Γ_m(φ) = Σ_n [φ]×ⁿ / (n + m)!  for m = 0 … 3 [Hartley20, eq. 30 ff.]. Γ0 is the exponential of
/// SO(3), Γ1 its left Jacobian. Of φ in rad; exact to round-off for every |φ| below π, and
/// continuous to 1e-13 where the series hands over to sines. Does not allocate.
inline Eigen::Matrix3d Gamma(int m, const Eigen::Vector3d& phi) {
  return RotationSeries<>(phi).Gamma(m);
}

/// Exp(φ) = Γ0(φ): the rotation by |φ| about φ.
inline Eigen::Matrix3d Exp(const Eigen::Vector3d& phi) { return Gamma(0, phi); }

/// The φ with Exp(φ) = R and |φ| ≤ π. Exact near the identity and near π.
Eigen::Vector3d Log(const Eigen::Matrix3d& R);

/// J(φ) = Γ1(φ), with Exp(φ + δ) ≈ Exp(J(φ) δ) Exp(φ).
inline Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& phi) { return Gamma(1, phi); }

/// J⁻¹(φ) for |φ| < 2π.
inline Eigen::Matrix3d LeftJacobianInverse(const Eigen::Vector3d& phi) {
  return RotationSeries<>(phi).LeftJacobianInverse();
}

/// R N Rᵀ: a covariance in other axes.
[[gnu::always_inline]] inline LaneMatrix Turned(const LaneMatrix& R, const LaneMatrix& N) {
  return TimesTransposed(R * N, R);
}
inline Eigen::Matrix3d Turned(const Eigen::Matrix3d& R, const Eigen::Matrix3d& N) {
  return ToEigen(Turned(ToLanes(R), ToLanes(N)));
}

}  // namespace reckon::estimator
