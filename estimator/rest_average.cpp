#include "reckon/estimator/rest_average.h"

#include <cmath>

namespace reckon::estimator {
namespace {

/// Samples before the scatter says anything.
constexpr int kFewestSamples = 10;
/// Scatter beyond this many believed sigmas, plus a floor for quantisation and a running engine,
/// is motion.
constexpr double kScatterFactor = 3.0;
constexpr double kGyroFloor = 5e-3;   ///< rad/s
constexpr double kAccelFloor = 5e-2;  ///< m/s²
/// A mean further from what the biases allow than this many sigmas is motion.
constexpr double kBiasSigmas = 6.0;
constexpr double kEncoderFloor = 0.02;  ///< rad/s

/// Sample variance of one axis at most.
double Largest(const Eigen::Vector3d& squares, int n) { return squares.maxCoeff() / (n - 1); }

}  // namespace

RestAverage::RestAverage(const Noise& noise, double period_s, double gravity_m_s2)
    : gyro_sigma_(noise.gyro_noise_density_rad_per_s_sqrt_hz / std::sqrt(period_s)),
      accel_sigma_(noise.accel_noise_density_m_per_s2_sqrt_hz / std::sqrt(period_s)),
      gravity_(gravity_m_s2) {}

void RestAverage::Restart() {
  gyro_ = {};
  accel_ = {};
  count_ = 0;
  seconds_ = 0.0;
}

void RestAverage::Add(const Eigen::Vector3d& w, const Eigen::Vector3d& a, double dt_s) {
  ++count_;
  seconds_ += dt_s;
  gyro_.Add(w, count_);
  accel_.Add(a, count_);
}

bool RestAverage::IsMotion(double rate_rad_s) { return std::abs(rate_rad_s) > kEncoderFloor; }

bool RestAverage::CanTell() const { return count_ >= kFewestSamples; }

bool RestAverage::LooksMoving(const BiasBelief& biases) const {
  const double gyro_limit = kScatterFactor * gyro_sigma_ + kGyroFloor;
  const double accel_limit = kScatterFactor * accel_sigma_ + kAccelFloor;
  if (Largest(gyro_.squares, count_) > gyro_limit * gyro_limit) return true;
  if (Largest(accel_.squares, count_) > accel_limit * accel_limit) return true;
  const double rate = (gyro_.mean - biases.gyro).cwiseAbs().maxCoeff();
  if (rate > kBiasSigmas * biases.gyro_sigma + kGyroFloor) return true;
  const double force = (accel_.mean - biases.accel).norm() - gravity_;
  return std::abs(force) > kBiasSigmas * biases.accel_sigma + kAccelFloor;
}

}  // namespace reckon::estimator
