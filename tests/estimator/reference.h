#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/navigation_state.h"

/// The textbook in long double, dense, and without a formula in common with the library: series by
/// their definition, Jacobians by differences.
namespace reckon::testing_estimator {

using Real = long double;
using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;
using VecX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using MatX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vec15 = Eigen::Matrix<Real, 15, 1>;
using Mat15 = Eigen::Matrix<Real, 15, 15>;
using estimator::ErrorForm;

inline Mat3 Cross(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Γ_m(φ) = Σ_n [φ]×ⁿ / (n + m)!, summed until nothing changes.
inline Mat3 Series(int m, const Vec3& phi) {
  Real factorial = 1;
  for (int i = 2; i <= m; ++i) factorial *= i;
  Mat3 term = Mat3::Identity() / factorial;
  Mat3 sum = Mat3::Zero();
  for (int n = 1; n < 80; ++n) {
    sum += term;
    term = term * Cross(phi) / static_cast<Real>(n + m);
  }
  return sum;
}

inline Vec3 LogOf(const Mat3& R) {
  const Vec3 w(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const Real sine = w.norm() / 2;
  const Real angle = std::atan2(sine, (R.trace() - 1) / 2);
  return sine > 0 ? Vec3(w * (angle / (2 * sine))) : Vec3(Vec3::Zero());
}

struct State {
  Mat3 R = Mat3::Identity();
  Vec3 v = Vec3::Zero(), p = Vec3::Zero(), bg = Vec3::Zero(), ba = Vec3::Zero();
};

inline State Widened(const estimator::NavigationState& x) {
  return {x.R.cast<Real>(), x.v.cast<Real>(), x.p.cast<Real>(), x.gyro_bias.cast<Real>(),
          x.accel_bias.cast<Real>()};
}

/// The 15 error coordinates of `hat` against `x`.
inline Vec15 Error(ErrorForm form, const State& hat, const State& x) {
  Vec15 e;
  const auto fill = [&e](const Mat3& dR, const Vec3& dv, const Vec3& dp) {
    const Vec3 theta = LogOf(dR);
    const Mat3 J = Series(1, theta).inverse();
    e.segment<3>(0) = theta;
    e.segment<3>(3) = J * dv;
    e.segment<3>(6) = J * dp;
  };
  const Mat3 right = hat.R * x.R.transpose();
  const Mat3 left = x.R.transpose() * hat.R;
  switch (form) {
    case ErrorForm::kRightInvariant:
      fill(right, hat.v - right * x.v, hat.p - right * x.p);
      break;
    case ErrorForm::kLeftInvariant:
      fill(left, x.R.transpose() * (hat.v - x.v), x.R.transpose() * (hat.p - x.p));
      break;
    case ErrorForm::kMultiplicative:
      e << LogOf(left), hat.v - x.v, hat.p - x.p, Vec3::Zero(), Vec3::Zero();
      break;
  }
  e.segment<3>(9) = hat.bg - x.bg;
  e.segment<3>(12) = hat.ba - x.ba;
  return e;
}

/// The estimate whose error against `x` is `e`.
inline State Erring(ErrorForm form, const State& x, const Vec15& e) {
  const Vec3 theta = e.segment<3>(0);
  const Mat3 turn = Series(0, theta);
  const Mat3 J = Series(1, theta);
  State hat = x;
  if (form == ErrorForm::kRightInvariant) {
    hat.R = turn * x.R;
    hat.v = turn * x.v + J * e.segment<3>(3);
    hat.p = turn * x.p + J * e.segment<3>(6);
  } else {
    const Mat3 M = form == ErrorForm::kLeftInvariant ? Mat3(x.R * J) : Mat3(Mat3::Identity());
    hat.R = x.R * turn;
    hat.v = x.v + M * e.segment<3>(3);
    hat.p = x.p + M * e.segment<3>(6);
  }
  hat.bg = x.bg + e.segment<3>(9);
  hat.ba = x.ba + e.segment<3>(12);
  return hat;
}

/// The truth against which `hat` has the error `e`, as it must be for linearising at an estimate.
inline State TruthBehind(ErrorForm form, const State& hat, const Vec15& e) {
  const Vec3 theta = e.segment<3>(0);
  const Mat3 back = Series(0, theta).transpose();
  const Mat3 J = Series(1, theta);
  State x = hat;
  if (form == ErrorForm::kRightInvariant) {
    x.R = back * hat.R;
    x.v = back * (hat.v - J * e.segment<3>(3));
    x.p = back * (hat.p - J * e.segment<3>(6));
  } else {
    x.R = hat.R * back;
    const Mat3 M = form == ErrorForm::kLeftInvariant ? Mat3(x.R * J) : Mat3(Mat3::Identity());
    x.v = hat.v - M * e.segment<3>(3);
    x.p = hat.p - M * e.segment<3>(6);
  }
  x.bg = hat.bg - e.segment<3>(9);
  x.ba = hat.ba - e.segment<3>(12);
  return x;
}

/// One IMU sample (gyroscope and accelerometer as read, in I) held over dt.
inline State Step(const State& x, const Vec3& gyro, const Vec3& accel, Real dt, Real gravity) {
  const Vec3 g(0, 0, -gravity);
  const Vec3 phi = (gyro - x.bg) * dt;
  const Vec3 a = accel - x.ba;
  State next = x;
  next.R = x.R * Series(0, phi);
  next.v = x.v + x.R * Series(1, phi) * a * dt + g * dt;
  next.p = x.p + x.v * dt + x.R * Series(2, phi) * a * dt * dt + g * dt * dt / 2;
  return next;
}

/// The Jacobian at zero of a function of `size` coordinates: central differences, one Richardson
/// step; good to about 1e-14 in long double.
template <class Function>
MatX DifferencesAtZero(const Function& f, Eigen::Index size) {
  constexpr Real h = 2e-4L;
  MatX J(VecX(f(VecX::Zero(size))).size(), size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto slope = [&](Real d) -> VecX {
      const VecX e = d * VecX::Unit(size, i);
      return (f(e) - f(-e)) / (2 * d);
    };
    J.col(i) = (4 * slope(h) - slope(2 * h)) / 3;
  }
  return J;
}

/// Likewise of 15 coordinates and so many rows.
template <int rows, class Function>
Eigen::Matrix<Real, rows, 15> Differences(const Function& f) {
  return DifferencesAtZero([&](const Vec15& e) { return f(e); }, 15);
}

/// max |A − B| over the entries, each in units of √(B_ii B_jj).
template <class A, class B>
double WorstCorrelationError(const A& a, const B& b) {
  Real worst = 0;
  for (int i = 0; i < b.rows(); ++i) {
    for (int j = 0; j < b.cols(); ++j) {
      const Real scale = std::sqrt(static_cast<Real>(b(i, i)) * static_cast<Real>(b(j, j)));
      worst = std::max(worst, std::abs(static_cast<Real>(a(i, j)) - b(i, j)) / scale);
    }
  }
  return static_cast<double>(worst);
}

}  // namespace reckon::testing_estimator
