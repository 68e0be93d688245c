#include "reckon/estimator/so3.h"

#include <Eigen/Geometry>
#include <array>
#include <cassert>
#include <cmath>

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSeries = 7;
constexpr std::array<double, kSeries> kInverseFactorial{1,        1,         1.0 / 2,  1.0 / 6,
                                                        1.0 / 24, 1.0 / 120, 1.0 / 720};

/// f_m(x) = Σ_k (−x)^k / (2k + m)!, m = 0 … 6, with f_m = 1/m! − x f_{m+2}.
using Series = std::array<double, kSeries>;

/// Below this x = |φ|² the two highest come from Horner's scheme and the recursion runs downwards,
/// where it only shrinks errors; above it runs upwards from sine and cosine.
constexpr double kSeriesLimit = 0.25;

/// Σ_k (−x)^k / (2k + m)! by Horner's scheme: nine terms leave 1e-21 at the limit.
double Horner(int m, double x) {
  double sum = 1.0;
  for (int k = 9; k > 0; --k) sum = 1.0 - x * sum / ((2 * k + m) * (2 * k + m - 1));
  return sum * kInverseFactorial[m];
}

Series Evaluate(double x) {
  Series f;
  if (x < kSeriesLimit) {
    f[6] = Horner(6, x);
    f[5] = Horner(5, x);
    for (int m = 4; m >= 0; --m) f[m] = kInverseFactorial[m] - x * f[m + 2];
  } else {
    const double angle = std::sqrt(x);
    f[0] = std::cos(angle);
    f[1] = std::sin(angle) / angle;
    for (int m = 2; m < kSeries; ++m) f[m] = (kInverseFactorial[m - 2] - f[m - 2]) / x;
  }
  return f;
}

/// f_m'(x) = (m f_{m+2} − f_{m+1}) / 2.
double Slope(const Series& f, int m) { return 0.5 * (m * f[m + 2] - f[m + 1]); }

}  // namespace

RotationSeries::RotationSeries(const Vector3d& phi) : phi_(phi), f_(Evaluate(phi.squaredNorm())) {}

Matrix3d RotationSeries::Gamma(int m) const {
  assert(m >= 0 && m <= 3);
  const double one = kInverseFactorial[m], first = f_[m + 1], second = f_[m + 2];
  // φ× φ× = φ φᵀ − |φ|² I.
  Matrix3d gamma = (second * phi_) * phi_.transpose();
  gamma.diagonal().array() += one - second * phi_.squaredNorm();
  gamma += first * Skew(phi_);
  return gamma;
}

Matrix3d RotationSeries::LeftJacobianInverse() const {
  const Matrix3d P = Skew(phi_);
  return Matrix3d::Identity() - 0.5 * P + (f_[3] - 2.0 * f_[4]) / (2.0 * f_[2]) * P * P;
}

Matrix3d RotationSeries::GammaDerivative(int m, const Vector3d& a) const {
  assert(m >= 1 && m <= 2);
  const Vector3d once = phi_.cross(a);
  const Vector3d twice = phi_.cross(once);
  // [φ]× [a]× = a φᵀ − (φ·a) I and [φ × a]× = a φᵀ − φ aᵀ.
  Matrix3d derivative = (-2.0 * f_[m + 2] * a) * phi_.transpose();
  derivative += (f_[m + 2] * phi_) * a.transpose();
  derivative.diagonal().array() += f_[m + 2] * phi_.dot(a);
  derivative -= f_[m + 1] * Skew(a);
  derivative += (2.0 * (Slope(f_, m + 1) * once + Slope(f_, m + 2) * twice)) * phi_.transpose();
  return derivative;
}

Vector3d Log(const Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  // atan2(s, c)/s → 1/c for small s: the quotient is exact to round-off there.
  const double ratio = sine > 1e-9 ? std::atan2(sine, q.w()) / sine : 1.0 / q.w();
  return 2.0 * ratio * q.vec();
}

}  // namespace reckon::estimator
