#include "reckon/estimator/wheel_odometry.h"

#include <stdexcept>

#include "reckon/estimator/sample_checks.h"
#include "reckon/estimator/so3.h"

namespace reckon::estimator {

using Eigen::Vector3d;

WheelOdometry::WheelOdometry(const Setup& setup) : suite_(setup.suite) {
  if (!setup.suite.wheels || setup.suite.wheels->left.empty() ||
      setup.suite.wheels->right.empty()) {
    throw std::invalid_argument("wheel odometry needs wheels on both sides");
  }
  drive_ = *setup.suite.wheels;
  if (!(drive_.effective_track_m > 0.0)) {
    throw std::invalid_argument("wheel odometry needs a positive effective track");
  }
}

void WheelOdometry::Start(const Prior& prior) {
  t_ns_ = prior.t_ns;
  X_WB_ = prior.X_WB;
  v_WB_ = prior.v_WB;
  started_ = true;
}

Report WheelOdometry::Process(const models::Measurement& measurement) {
  Report report;
  report.refusal = WhatIsWrong(measurement, suite_);
  if (report.refusal != Refusal::kNone) return report;
  const auto* sample = std::get_if<models::EncoderSample>(&measurement.sample);
  const auto rates = sample != nullptr && suite_.sensors[measurement.sensor].name == drive_.encoders
                         ? MeanRates(*sample, drive_)
                         : std::nullopt;
  if (!rates || !started_) {
    report.refusal = started_ ? Refusal::kUnused : Refusal::kNotInitialised;
    return report;
  }
  if (measurement.valid_ns <= t_ns_) {
    report.refusal = Refusal::kBackwards;
    return report;
  }
  const double dt = models::Seconds(measurement.valid_ns - t_ns_);
  const double speed = drive_.rolling_radius_m * 0.5 * (rates->left + rates->right);
  const double yaw_rate =
      drive_.rolling_radius_m * (rates->right - rates->left) / drive_.effective_track_m;
  const Vector3d w(0, 0, yaw_rate);
  // The drive's frame moves straight ahead in its own axes; the body turns about its own vertical.
  const Vector3d v_B = drive_.X_BS.R * Vector3d(speed, 0, 0) - w.cross(drive_.X_BS.p);
  const Eigen::Matrix3d R = X_WB_.R;
  X_WB_.p += R * (Gamma(1, w * dt) * v_B) * dt;
  X_WB_.R = R * Exp(w * dt);
  v_WB_ = X_WB_.R * v_B;
  t_ns_ = measurement.valid_ns;
  report.propagated = true;
  return report;
}

std::optional<Estimate> WheelOdometry::Belief() const {
  if (!started_) return std::nullopt;
  Estimate estimate;
  estimate.t_ns = t_ns_;
  estimate.X_WB = X_WB_;
  estimate.v_WB = v_WB_;
  return estimate;
}

}  // namespace reckon::estimator
