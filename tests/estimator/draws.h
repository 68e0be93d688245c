#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "reckon/estimator/navigation_state.h"

namespace reckon::testing_estimator {

/// Random test values from a fixed seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}

  double Normal() { return normal_(engine_); }
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  template <int n>
  Eigen::Matrix<double, n, 1> Normals() {
    Eigen::Matrix<double, n, 1> x;
    for (int i = 0; i < n; ++i) x[i] = Normal();
    return x;
  }
  Eigen::Vector3d Vector(double sigma = 1.0) { return sigma * Normals<3>(); }

  /// Uniform over SO(3).
  Eigen::Matrix3d Rotation() {
    const Eigen::Vector4d q = Normals<4>().normalized();
    return Eigen::Quaterniond(q).toRotationMatrix();
  }

  /// Positive definite, with correlations and the given standard deviations on its diagonal.
  template <int n>
  Eigen::Matrix<double, n, n> Covariance(const Eigen::Matrix<double, n, 1>& sigma) {
    Eigen::Matrix<double, n, n> A;
    for (int i = 0; i < n; ++i) A.row(i) = Normals<n>().transpose();
    A += 2.0 * Eigen::Matrix<double, n, n>::Identity();
    Eigen::Matrix<double, n, n> P = A * A.transpose();
    const Eigen::Matrix<double, n, 1> scale = sigma.array() / P.diagonal().array().sqrt();
    P = scale.asDiagonal() * P * scale.asDiagonal();
    return 0.5 * (P + P.transpose());
  }

  estimator::NavigationState State() {
    estimator::NavigationState x;
    x.R = Rotation();
    x.v = Vector(2.0);
    x.p = Vector(20.0);
    x.gyro_bias = Vector(0.02);
    x.accel_bias = Vector(0.1);
    return x;
  }

  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// Standard deviations of the kind that a filter meets.
inline Eigen::Matrix<double, 15, 1> UsualSigma() {
  Eigen::Matrix<double, 15, 1> s;
  s << 0.02, 0.02, 0.1, 0.05, 0.05, 0.05, 1, 1, 1, 1e-3, 1e-3, 1e-3, 0.02, 0.02, 0.02;
  return s;
}

}  // namespace reckon::testing_estimator
