#pragma once

#include <memory>
#include <string>

#include "reckon/estimator/registry.h"
#include "reckon/estimator/so3.h"

namespace reckon::testing_estimator {

using models::Measurement;
using models::TimeNs;

inline constexpr TimeNs kMs = 1'000'000;
inline constexpr models::SensorId kImu = 0, kWheels = 1, kVelocity = 2, kSecondImu = 3;

/// A small robot: IMU at 200 Hz, turned and off the body's origin, four wheels, a velocity sensor.
inline estimator::Setup TestSetup() {
  estimator::Setup setup;
  const models::Pose X_BI{estimator::Exp({0.1, -0.2, 0.3}), Eigen::Vector3d(0.19, 0.03, 0.15)};
  const models::Pose X_BV{estimator::Exp({0, 0, 1.0}), Eigen::Vector3d(-0.3, 0.1, -0.2)};
  setup.suite.sensors = {{"imu", models::SensorKind::kImu, X_BI, 5 * kMs},
                         {"wheels", models::SensorKind::kEncoders, {}, 20 * kMs},
                         {"velocity", models::SensorKind::kBodyVelocity, X_BV, 50 * kMs},
                         {"spare_imu", models::SensorKind::kImu, {}, 5 * kMs}};
  models::WheelDrive drive;
  drive.encoders = "wheels";
  drive.left = {0, 2};
  drive.right = {1, 3};
  drive.rolling_radius_m = 0.2;
  drive.effective_track_m = 1.0;
  setup.suite.wheels = drive;
  setup.noise = {.gyro_noise_density_rad_per_s_sqrt_hz = 1e-4,
                 .accel_noise_density_m_per_s2_sqrt_hz = 2e-3,
                 .gyro_bias_walk_rad_per_s2_sqrt_hz = 1e-5,
                 .accel_bias_walk_m_per_s3_sqrt_hz = 1e-4,
                 .wheel_forward_m_per_s = 0.02,
                 .wheel_lateral_m_per_s = 0.03,
                 .wheel_vertical_m_per_s = 0.03};
  return setup;
}

/// A prior at rest at the origin with usual uncertainty.
inline estimator::Prior TestPrior() {
  estimator::Prior prior;
  Eigen::Matrix<double, 15, 1> s;
  s << 0.02, 0.02, 0.01, 0.05, 0.05, 0.05, 0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3, 0.02, 0.02, 0.02;
  prior.covariance = s.cwiseAbs2().asDiagonal();
  return prior;
}

inline std::unique_ptr<estimator::Estimator> Make(const std::string& name,
                                                  const estimator::Setup& setup = TestSetup(),
                                                  const estimator::Prior& prior = TestPrior()) {
  auto made = estimator::FindEstimator(name)->make(setup);
  made->Start(prior);
  return made;
}

/// What an IMU at rest on level ground reads; `t` is the end of its interval.
inline Measurement RestingImu(TimeNs t, const estimator::Setup& setup = TestSetup()) {
  models::ImuSample sample;
  sample.accel_m_s2 =
      setup.suite.sensors[kImu].X_BS.R.transpose() * Eigen::Vector3d(0, 0, setup.gravity_m_s2);
  sample.interval_ns = 5 * kMs;
  return {kImu, t, t, sample};
}

inline Measurement WheelsAt(TimeNs t, double left_rad_s, double right_rad_s) {
  models::EncoderSample sample;
  sample.rate_rad_s.resize(4);
  sample.rate_rad_s << left_rad_s, right_rad_s, left_rad_s, right_rad_s;
  sample.angle_rad = Eigen::Vector4d::Zero();
  sample.interval_ns = 20 * kMs;
  return {kWheels, t, t, sample};
}

inline Measurement VelocityAt(TimeNs t, const Eigen::Vector3d& v_WS_S, double sigma = 0.02) {
  models::BodyVelocitySample sample;
  sample.v_WS_S = v_WS_S;
  sample.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
  return {kVelocity, t, t, sample};
}

}  // namespace reckon::testing_estimator
