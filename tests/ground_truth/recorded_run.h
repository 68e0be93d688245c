#pragma once

#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "reckon/ground_truth/run_recorder.h"

namespace reckon::ground_truth::testing {

/// A folder of its own that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "reckon_test_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Two wheels, an IMU, their encoders and a body velocity; two estimators.
inline RecordingPlan SmallPlan() {
  RecordingPlan plan;
  plan.sensors.resize(3);
  models::MountedSensor& imu = plan.sensors[0].sensor;
  imu.name = "imu";
  imu.period_ns = 5'000'000;
  imu.X_BS.R = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).matrix();
  imu.X_BS.p = {0.1, 0.2, 0.3};
  plan.sensors[1].sensor.name = "encoders";
  plan.sensors[1].sensor.kind = models::SensorKind::kEncoders;
  plan.sensors[1].channels = {"left", "right"};
  plan.sensors[2].sensor.name = "dvl";
  plan.sensors[2].sensor.kind = models::SensorKind::kBodyVelocity;
  plan.estimators = {"riekf", "odometry"};
  plan.wheels = {"left", "right"};
  plan.attributes = {{"resolved_scenario", "schema: 1\nname: ünïcode\n"}};
  return plan;
}

inline Eigen::Matrix3d SomeRotation(double seed) {
  return Eigen::AngleAxisd(seed, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).matrix();
}

inline Truth SomeTruth(models::TimeNs t_ns) {
  const double s = 1e-3 * static_cast<double>(t_ns % 999'983) + 0.1;
  Truth truth;
  truth.t_ns = t_ns;
  truth.X_WB = {SomeRotation(s), {s, 2.0 / s, -s}};
  truth.v_WB = {1.0 / s, s, 3.0};
  truth.w_WB_B = {s, -0.1, 1.0 / 3.0};
  truth.gyro_bias_rad_s = {1e-3 * s, 0.0, -0.0};
  truth.accel_bias_m_s2 = {1e-300, s, 1e300};
  truth.wheel_rate_rad_s = models::EncoderVector::Constant(2, s);
  truth.wheel_slip_m_s = models::EncoderVector::Constant(2, 2.0 * s);
  truth.wheel_load_n = models::EncoderVector::Constant(2, 3.0 * s);
  return truth;
}

inline estimator::Estimate SomeEstimate(models::TimeNs t_ns) {
  const Truth truth = SomeTruth(t_ns + 7);
  estimator::Estimate estimate;
  estimate.t_ns = t_ns;
  estimate.X_WB = truth.X_WB;
  estimate.v_WB = truth.v_WB;
  estimate.gyro_bias_rad_s = truth.gyro_bias_rad_s;
  estimate.accel_bias_m_s2 = truth.accel_bias_m_s2;
  estimate.form = estimator::ErrorForm::kMultiplicative;
  estimate.has_biases = true;
  estimate.has_covariance = true;
  for (int i = 0; i < estimator::kErrorSize; ++i) {
    for (int j = 0; j <= i; ++j) {
      estimate.covariance(i, j) = estimate.covariance(j, i) = truth.X_WB.p.x() / (i + 3 * j + 1);
    }
  }
  return estimate;
}

inline models::Measurement ImuAt(models::TimeNs t_ns) {
  models::ImuSample sample;
  sample.gyro_rad_s = {0.1, 0.2, 1e-9 * static_cast<double>(t_ns)};
  sample.accel_m_s2 = {0.0, -0.0, 9.81};
  sample.interval_ns = 5'000'000;
  sample.accel_saturated = true;
  return {0, t_ns, t_ns + 3, sample};
}

inline models::Measurement EncodersAt(models::TimeNs t_ns) {
  models::EncoderSample sample;
  sample.angle_rad = models::EncoderVector::Constant(2, 1e-9 * static_cast<double>(t_ns));
  sample.rate_rad_s = models::EncoderVector::Constant(2, 4.0);
  sample.interval_ns = 20'000'000;
  return {1, t_ns, t_ns + 5, sample};
}

inline models::Measurement DvlAt(models::TimeNs t_ns) {
  models::BodyVelocitySample sample;
  sample.v_WS_S = {1.0, std::numeric_limits<double>::quiet_NaN(), 1e-9 * static_cast<double>(t_ns)};
  sample.covariance << 1, 2, 3, 4, 5, 6, 7, 8, 9;  // not symmetric: it must come back all the same
  return {2, t_ns, t_ns + 7, sample};
}

}  // namespace reckon::ground_truth::testing
