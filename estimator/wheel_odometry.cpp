#include "reckon/estimator/wheel_odometry.h"

#include <stdexcept>

#include "reckon/estimator/sample_checks.h"
#include "reckon/estimator/setup_checks.h"
#include "reckon/estimator/so3.h"

namespace reckon::estimator {

using Eigen::Vector3d;

WheelOdometry::WheelOdometry(const Setup& setup) : suite_(setup.suite) {
  CheckDrive(setup.suite);
  drive_ = *setup.suite.wheels;
  if (!(drive_.effective_track_m > 0.0)) {
    throw std::invalid_argument("wheel odometry needs a positive effective track");
  }
}

void WheelOdometry::Start(const Prior& prior) {
  CheckPrior(prior);
  t_ns_ = prior.t_ns;
  X_WB_ = prior.X_WB;
  v_WB_ = prior.v_WB;
  started_ = true;
}

Report WheelOdometry::Process(const models::Measurement& measurement) {
  Report report;
  report.refusal = WhatIsWrong(measurement, suite_);
  if (report.refusal != Refusal::kNone) return report;
  if (!started_) {
    report.refusal = Refusal::kNotInitialised;
  } else if (suite_.sensors[measurement.sensor].name != drive_.encoders) {
    report.refusal = Refusal::kUnused;
  } else {
    Move(measurement.valid_ns, std::get<models::EncoderSample>(measurement.sample), report);
  }
  return report;
}

void WheelOdometry::Move(models::TimeNs to_ns, const models::EncoderSample& sample,
                         Report& report) {
  const auto rates = MeanRates(sample, drive_);
  if (!rates) report.refusal = Refusal::kInvalid;
  if (to_ns <= t_ns_) report.refusal = Refusal::kBackwards;
  if (to_ns - t_ns_ > kLongestGap) report.refusal = Refusal::kGap;
  if (report.refusal != Refusal::kNone) return;
  const double dt = models::Seconds(to_ns - t_ns_);
  const double speed = drive_.rolling_radius_m * 0.5 * (rates->left + rates->right);
  const Vector3d w(0, 0, WheelYawRate(*rates, drive_));
  // The drive's frame moves straight ahead in its own axes; the body turns about its own vertical.
  const Vector3d v_B = drive_.X_BS.R * Vector3d(speed, 0, 0) - w.cross(drive_.X_BS.p);
  const Eigen::Matrix3d R = X_WB_.R;
  X_WB_.p += R * (Gamma(1, w * dt) * v_B) * dt;
  X_WB_.R = R * Exp(w * dt);
  v_WB_ = X_WB_.R * v_B;
  t_ns_ = to_ns;
  report.propagated = true;
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
