#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth::testing {

inline Eigen::Matrix3d Rot(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline Eigen::Matrix3d Rz(double yaw) { return Rot(yaw, Eigen::Vector3d::UnitZ()); }

/// True pose and velocity at a time of a drive around a circle of 5 m at 1 m/s that also goes up,
/// down and tilts.
inline Truth CircleTruth(models::TimeNs t_ns) {
  const double t = models::Seconds(t_ns), a = 0.2 * t;
  Truth truth;
  truth.t_ns = t_ns;
  truth.X_WB = {Rz(a) * Rot(0.1 * std::sin(t), Eigen::Vector3d::UnitX()),
                {5.0 * std::sin(a), 5.0 - 5.0 * std::cos(a), 0.3 * std::sin(0.7 * t)}};
  truth.v_WB = {std::cos(a), std::sin(a), 0.21 * std::cos(0.7 * t)};
  return truth;
}

/// The estimate that equals the truth.
inline estimator::Estimate Exact(const Truth& truth) {
  estimator::Estimate estimate;
  estimate.t_ns = truth.t_ns;
  estimate.X_WB = truth.X_WB;
  estimate.v_WB = truth.v_WB;
  estimate.gyro_bias_rad_s = truth.gyro_bias_rad_s;
  estimate.accel_bias_m_s2 = truth.accel_bias_m_s2;
  return estimate;
}

/// A circle, sampled `count` times at `rate_hz`; `spoil` turns exact estimates into wrong ones.
inline Track CircleTrack(int count, double rate_hz,
                         const std::function<void(estimator::Estimate&)>& spoil) {
  Track track;
  for (int k = 0; k < count; ++k) {
    const Truth truth = CircleTruth(std::llround(1e9 * k / rate_hz));
    estimator::Estimate estimate = Exact(truth);
    spoil(estimate);
    track.Add(truth, estimate);
  }
  return track;
}

/// A straight drive along x at 1 m a sample and second; estimates are off by `error(k)`.
inline Track LineTrack(int count, const std::function<Eigen::Vector3d(int)>& error) {
  Track track;
  for (int k = 0; k < count; ++k) {
    Truth truth;
    truth.t_ns = k * models::kNsPerSecond;
    truth.X_WB.p.x() = k;
    truth.v_WB.x() = 1.0;
    estimator::Estimate estimate = Exact(truth);
    estimate.X_WB.p += error(k);
    track.Add(truth, estimate);
  }
  return track;
}

}  // namespace reckon::ground_truth::testing
