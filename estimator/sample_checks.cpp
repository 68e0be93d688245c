#include "reckon/estimator/sample_checks.h"

#include <Eigen/Cholesky>

namespace reckon::estimator {
namespace {

// No hardware reports more: what lies beyond is a broken message, not an outlier for the gate.
constexpr double kLargestRate = 1e4;      ///< rad/s, IMU and encoders
constexpr double kLargestForce = 1e5;     ///< m/s²
constexpr double kLargestVelocity = 1e5;  ///< m/s
constexpr double kLargestDistance = 1e7;  ///< m
constexpr double kLargestSigma = 1e6;     ///< m or rad
constexpr double kLargestLoad = 1e7;      ///< N m or N
constexpr models::TimeNs kLongestInterval = models::kNsPerSecond;

template <class Vector>
Refusal Bounded(const Vector& x, double limit) {
  if (!x.allFinite()) return Refusal::kNotFinite;
  return x.size() > 0 && x.cwiseAbs().maxCoeff() > limit ? Refusal::kInvalid : Refusal::kNone;
}

Refusal WorseOf(Refusal a, Refusal b) { return a != Refusal::kNone ? a : b; }

Refusal Interval(models::TimeNs interval_ns) {
  if (interval_ns <= 0) return Refusal::kInvalid;
  return interval_ns > kLongestInterval ? Refusal::kGap : Refusal::kNone;
}

Refusal Check(const models::ImuSample& sample) {
  const Refusal numbers =
      WorseOf(Bounded(sample.gyro_rad_s, kLargestRate), Bounded(sample.accel_m_s2, kLargestForce));
  return WorseOf(numbers, Interval(sample.interval_ns));
}

Refusal Check(const models::EncoderSample& sample) {
  if (sample.rate_rad_s.size() == 0 || sample.rate_rad_s.size() != sample.angle_rad.size()) {
    return Refusal::kInvalid;
  }
  if (!sample.angle_rad.allFinite()) return Refusal::kNotFinite;
  return WorseOf(Bounded(sample.rate_rad_s, kLargestRate), Interval(sample.interval_ns));
}

Refusal Check(const models::BodyVelocitySample& sample) {
  if (!sample.valid) return Refusal::kNoLock;
  if (!sample.covariance.allFinite()) return Refusal::kNotFinite;
  const Refusal numbers = Bounded(sample.v_WS_S, kLargestVelocity);
  if (numbers != Refusal::kNone) return numbers;
  const Eigen::LLT<Eigen::Matrix3d> factor(sample.covariance);
  const bool symmetric = sample.covariance.isApprox(sample.covariance.transpose(), 1e-9);
  return factor.info() == Eigen::Success && symmetric ? Refusal::kNone : Refusal::kInvalid;
}

Refusal Check(const models::DepthSample& sample) {
  return Bounded(Eigen::Matrix<double, 1, 1>(sample.depth_m), kLargestDistance);
}

/// Standard deviations: positive, and not beyond all meaning.
Refusal Sigmas(const Eigen::Vector3d& sigma) {
  if (!sigma.allFinite()) return Refusal::kNotFinite;
  const bool good = sigma.minCoeff() > 0.0 && sigma.maxCoeff() <= kLargestSigma;
  return good ? Refusal::kNone : Refusal::kInvalid;
}

Refusal Check(const models::PoseSample& sample) {
  const Refusal position =
      WorseOf(Bounded(sample.X_WS.p, kLargestDistance), Sigmas(sample.position_sigma_m));
  if (position != Refusal::kNone || !sample.has_orientation) return position;
  if (!sample.X_WS.R.allFinite()) return Refusal::kNotFinite;
  const bool rotation = sample.X_WS.R.isUnitary(1e-6) && sample.X_WS.R.determinant() > 0.0;
  return rotation ? Sigmas(sample.orientation_sigma_rad) : Refusal::kInvalid;
}

Refusal Check(const models::ContactSample& sample) {
  if (!sample.probability.allFinite()) return Refusal::kNotFinite;
  const bool good = sample.probability.size() > 0 && sample.probability.minCoeff() >= 0.0 &&
                    sample.probability.maxCoeff() <= 1.0;
  return good ? Refusal::kNone : Refusal::kInvalid;
}

Refusal Check(const models::TorqueSample& sample) {
  if (sample.torque_n_m.size() == 0) return Refusal::kInvalid;
  return Bounded(sample.torque_n_m, kLargestLoad);
}

Refusal Check(const models::FootForceSample& sample) {
  if (sample.force_n.size() == 0) return Refusal::kInvalid;
  return Bounded(sample.force_n, kLargestLoad);
}

}  // namespace

Refusal WhatIsWrong(const models::Measurement& measurement, const models::Suite& suite) {
  if (measurement.sensor >= suite.sensors.size()) return Refusal::kInvalid;
  const auto kind = static_cast<std::size_t>(suite.sensors[measurement.sensor].kind);
  if (measurement.sample.index() != kind) return Refusal::kInvalid;
  if (measurement.valid_ns < 0) return Refusal::kInvalid;
  if (measurement.valid_ns > measurement.arrival_ns) return Refusal::kFromFuture;
  return std::visit([](const auto& sample) { return Check(sample); }, measurement.sample);
}

}  // namespace reckon::estimator
