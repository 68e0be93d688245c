#include "reckon/sim/rotation_vector.h"

#include <cmath>

#include <Eigen/Geometry>

namespace reckon::sim {
namespace {

/// Below this |φ|² the series are exact to double precision and the closed forms are not.
constexpr double kSeriesBelow = 1e-2;

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// I + a [φ]× + b [φ]×².
Eigen::Matrix3d Polynomial(const Eigen::Vector3d& phi, double a, double b) {
  const Eigen::Matrix3d K = Skew(phi);
  return Eigen::Matrix3d::Identity() + a * K + b * K * K;
}

}  // namespace

Eigen::Matrix3d RotationExp(const Eigen::Vector3d& phi) {
  const double x = phi.squaredNorm();
  if (x < kSeriesBelow) {
    const double a = 1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0)));
    const double b = 0.5 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0)));
    return Polynomial(phi, a, b);
  }
  const double angle = std::sqrt(x);
  return Polynomial(phi, std::sin(angle) / angle, (1.0 - std::cos(angle)) / x);
}

Eigen::Vector3d RotationLog(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  // atan(s/w)/s → 1/w as s → 0.
  const double factor = s < 1e-9 ? 2.0 / q.w() : 2.0 * std::atan2(s, q.w()) / s;
  return factor * q.vec();
}

Eigen::Matrix3d Gamma1(const Eigen::Vector3d& phi) {
  const double x = phi.squaredNorm();
  if (x < kSeriesBelow) {
    const double a = 0.5 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0)));
    const double b = 1.0 / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0)));
    return Polynomial(phi, a, b);
  }
  const double angle = std::sqrt(x);
  return Polynomial(phi, (1.0 - std::cos(angle)) / x, (angle - std::sin(angle)) / (x * angle));
}

Eigen::Matrix3d Gamma1Inverse(const Eigen::Vector3d& phi) {
  const double x = phi.squaredNorm();
  double b = 0.0;
  if (x < kSeriesBelow) {
    b = 1.0 / 12.0 + x / 720.0 + x * x / 30240.0 + x * x * x / 1209600.0;
  } else {
    const double half = 0.5 * std::sqrt(x);
    b = (1.0 - half / std::tan(half)) / x;
  }
  return Polynomial(phi, -0.5, b);
}

}  // namespace reckon::sim
