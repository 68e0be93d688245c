#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ground_truth/recorded_run.h"
#include "reckon/ground_truth/recording_reader.h"
#include "reckon/harness/run.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness::testing {

using ground_truth::testing::Bytes;
using ground_truth::testing::TemporaryFolder;

/// Two seconds with everything that draws random numbers: terrain, biases, noise and faults.
inline constexpr const char* kBusyScenario = R"(
duration_s: 2
seed: 3
world: {terrain: {kind: rough}}
motion: {path: circle, radius_m: 3, start_s: 0.2}
sensors:
  imu: {grade: mpu6050, latency_s: 0.003}
  wheels: {noise_rad: 1.0e-4, offset_rad: 1}
faults:
  - {sensor: imu, kind: outlier_burst, at_s: 1, for_s: 0.2, std: 0.1}
  - {sensor: wheels, kind: time_jitter, at_s: 1.2, for_s: 0.3, std_s: 0.002}
estimators:
  riekf: {type: inekf}
  mekf: {type: mekf}
  odometry: {type: odometry}
)";

inline Scenario BusyScenario(const std::vector<std::string>& overrides = {}) {
  return ReadScenarioText(kBusyScenario, "busy.yaml", overrides);
}

/// Runs `scenario` below `out` and gives the folder of its result.
inline std::filesystem::path RunIn(const std::filesystem::path& out, const Scenario& scenario,
                                   const std::string& name = "busy", bool poison_truth = false) {
  RunOptions options;
  options.out = out;
  options.poison_truth = poison_truth;
  const RunResult result = RunScenario(scenario, name, options);
  EXPECT_EQ(result.outcome, Outcome::kFinished) << result.failure;
  return result.folder;
}

/// All files of a result by name, but for run.json, which tells wall times.
inline std::map<std::string, std::string> ReproducibleFiles(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "run.json") files[name] = Bytes(entry.path());
  }
  return files;
}

/// Expects the same files with the same bytes, and says which differ.
inline void ExpectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto left = ReproducibleFiles(a), right = ReproducibleFiles(b);
  for (const char* name : {"recording.h5", "metrics.json", "resolved.yaml", "truth.tum"}) {
    EXPECT_TRUE(left.contains(name)) << name;
  }
  ASSERT_EQ(left.size(), right.size());
  for (const auto& [name, bytes] : left) {
    ASSERT_TRUE(right.contains(name)) << name;
    EXPECT_TRUE(bytes == right.at(name)) << name << " differs";
    EXPECT_FALSE(bytes.empty()) << name;
  }
}

/// The bits of some numbers, to be compared exactly: NaN equals itself, 0 differs from -0.
class Bits {
 public:
  void Add(std::int64_t value) { AddRaw(&value, sizeof(value)); }
  template <class Matrix>
  void AddMatrix(const Matrix& matrix) {
    AddRaw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }
  const std::string& text() const { return text_; }

 private:
  void AddRaw(const void* data, std::size_t size) {
    text_.append(static_cast<const char*>(data), size);
  }
  std::string text_;
};

inline std::string BitsOf(const estimator::Estimate& estimate) {
  Bits bits;
  bits.Add(estimate.t_ns);
  bits.AddMatrix(estimate.X_WB.R);
  bits.AddMatrix(estimate.X_WB.p);
  bits.AddMatrix(estimate.v_WB);
  bits.AddMatrix(estimate.gyro_bias_rad_s);
  bits.AddMatrix(estimate.accel_bias_m_s2);
  bits.AddMatrix(estimate.covariance);
  return bits.text();
}

inline std::string BitsOf(const models::Measurement& measurement) {
  Bits bits;
  bits.Add(measurement.valid_ns);
  bits.Add(measurement.arrival_ns);
  if (const auto* imu = std::get_if<models::ImuSample>(&measurement.sample)) {
    bits.AddMatrix(imu->gyro_rad_s);
    bits.AddMatrix(imu->accel_m_s2);
    bits.Add(imu->interval_ns);
  } else if (const auto* encoders = std::get_if<models::EncoderSample>(&measurement.sample)) {
    bits.AddMatrix(encoders->angle_rad);
    bits.AddMatrix(encoders->rate_rad_s);
  } else if (const auto* velocity = std::get_if<models::BodyVelocitySample>(&measurement.sample)) {
    bits.AddMatrix(velocity->v_WS_S);
    bits.AddMatrix(velocity->covariance);
  } else if (const auto* depth = std::get_if<models::DepthSample>(&measurement.sample)) {
    bits.AddMatrix(Eigen::Matrix<double, 1, 1>(depth->depth_m));
  } else if (const auto* pose = std::get_if<models::PoseSample>(&measurement.sample)) {
    bits.AddMatrix(pose->X_WS.R);
    bits.AddMatrix(pose->X_WS.p);
    bits.AddMatrix(pose->position_sigma_m);
    bits.AddMatrix(pose->orientation_sigma_rad);
    bits.Add(pose->has_orientation ? 1 : 0);
  } else if (const auto* contacts = std::get_if<models::ContactSample>(&measurement.sample)) {
    bits.AddMatrix(contacts->probability);
  }
  return bits.text();
}

using Streams = std::map<std::string, std::vector<std::string>>;

/// Every row of every estimate in a recording, by estimator.
inline Streams EstimateStreams(const std::filesystem::path& recording) {
  const ground_truth::RecordingReader reader(recording);
  Streams streams;
  for (std::size_t i = 0; i < reader.estimators().size(); ++i) {
    auto& rows = streams[reader.estimators()[i]];
    auto cursor = reader.ReadEstimates(i);
    while (const auto estimate = cursor.Next()) rows.push_back(BitsOf(*estimate));
  }
  return streams;
}

/// Every measurement in a recording, by sensor.
inline Streams MeasurementStreams(const std::filesystem::path& recording) {
  const ground_truth::RecordingReader reader(recording);
  Streams streams;
  auto cursor = reader.ReadMeasurements();
  while (const auto measurement = cursor.Next()) {
    streams[reader.sensors()[measurement->sensor].name].push_back(BitsOf(*measurement));
  }
  return streams;
}

}  // namespace reckon::harness::testing
