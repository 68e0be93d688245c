#include "reckon/estimator/so3.h"

#include <Eigen/Geometry>
#include <array>
#include <cassert>
#include <cmath>

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::array<double, 7> kInverseFactorial{1,        1,         1.0 / 2,  1.0 / 6,
                                                  1.0 / 24, 1.0 / 120, 1.0 / 720};

/// Below this x = |φ|² the two highest come from Horner's scheme and the recursion runs downwards,
/// where it only shrinks errors; above it runs upwards from sine and cosine.
constexpr double kSeriesLimit = 0.25;
/// Terms of the series that leave less than 1e-17 of it up to there, and up to 0.03 rad.
constexpr int kTerms = 8, kTermsOfSmall = 3;
constexpr double kSmall = 1e-3;

/// f_m(x) by Horner's scheme.
template <int m, int kLast>
double Horner(double x) {
  constexpr auto kFactors = [] {
    std::array<double, kLast> factors{};  // of each coefficient to the one before
    for (int k = 1; k <= kLast; ++k) factors[k - 1] = -1.0 / ((2 * k + m) * (2 * k + m - 1));
    return factors;
  }();
  double sum = 1.0;
  for (int k = kLast; k > 0; --k) sum = 1.0 + kFactors[k - 1] * x * sum;
  return sum * kInverseFactorial[m];
}

}  // namespace

template <int kHighest>
RotationSeries<kHighest>::RotationSeries(Lane phi) : phi_(phi) {
  const double x = Dot(phi, phi);
  if (x < kSeriesLimit) {
    const bool small = x < kSmall;
    f_[kHighest] = small ? Horner<kHighest, kTermsOfSmall>(x) : Horner<kHighest, kTerms>(x);
    f_[kHighest - 1] =
        small ? Horner<kHighest - 1, kTermsOfSmall>(x) : Horner<kHighest - 1, kTerms>(x);
    for (int m = kHighest - 2; m >= 0; --m) f_[m] = kInverseFactorial[m] - x * f_[m + 2];
  } else {
    const double angle = std::sqrt(x);
    f_[0] = std::cos(angle);
    f_[1] = std::sin(angle) / angle;
    for (int m = 2; m <= kHighest; ++m) f_[m] = (kInverseFactorial[m - 2] - f_[m - 2]) / x;
  }
}

template <int kHighest>
Matrix3d RotationSeries<kHighest>::LeftJacobianInverse() const {
  static_assert(kHighest >= 4);
  const Matrix3d P = Skew(ToEigen(phi_));
  return Matrix3d::Identity() - 0.5 * P + (f_[3] - 2.0 * f_[4]) / (2.0 * f_[2]) * P * P;
}

template RotationSeries<3>::RotationSeries(Lane phi);
template class RotationSeries<6>;

Vector3d Log(const Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  // atan2(s, c)/s → 1/c for small s: the quotient is exact to round-off there.
  const double ratio = sine > 1e-9 ? std::atan2(sine, q.w()) / sine : 1.0 / q.w();
  return 2.0 * ratio * q.vec();
}

}  // namespace reckon::estimator
