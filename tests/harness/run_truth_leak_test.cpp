// Truth becomes belief at one place, the draw of the prior. Afterwards it may be anything.

#include <gtest/gtest.h>

#include <cmath>

#include "harness/run_case.h"
#include "reckon/harness/recording_log.h"
#include "reckon/harness/replay_experiment.h"
#include "reckon/harness/robot_file.h"

namespace reckon::harness {
namespace {

using testing::BusyScenario;
using testing::EstimateStreams;
using testing::RunIn;
using testing::Streams;
using testing::TemporaryFolder;

// 200 Hz for 2 s: an IMU sample is valid every 5 ms, latency keeps the last from arriving.
constexpr std::size_t kImuSamples = 399;

/// Replays `recording` and gives what the estimators say now.
Streams Replayed(const std::filesystem::path& recording, const Scenario& scenario,
                 const std::filesystem::path& to) {
  ground_truth::RecordingPlan plan;
  const ground_truth::RecordingReader reader(recording);
  for (const auto& sensor : reader.sensors()) {
    plan.sensors.push_back({sensor, {}});
    if (sensor.kind == models::SensorKind::kEncoders) {
      plan.sensors.back().channels = LoadRobot(scenario).joints;
    }
  }
  for (const auto& [name, config] : scenario.estimators) plan.estimators.push_back(name);
  plan.truth = false;
  ground_truth::RunRecorder recorder(to, plan);
  ReplayExperiment replay(scenario, LoadRobot(scenario).nominal,
                          std::make_unique<RecordingLog>(recording), &recorder);
  EXPECT_TRUE(replay.Run({}));
  recorder.Close();
  return EstimateStreams(to);
}

TEST(TruthLeak, PoisonedTruthChangesNoEstimate) {
  const TemporaryFolder folder;
  const auto clean = RunIn(folder / "clean", BusyScenario()) / "recording.h5";
  const auto poisoned = RunIn(folder / "poisoned", BusyScenario(), "busy", true) / "recording.h5";

  // The poison is there, from the first row on.
  const ground_truth::RecordingReader reader(poisoned);
  auto truths = reader.ReadTruth();
  int rows = 0;
  for (; const auto truth = truths.Next(); ++rows) {
    ASSERT_TRUE(std::isnan(truth->X_WB.p.x()) && std::isnan(truth->v_WB.x()));
  }
  EXPECT_EQ(rows, 2001);

  const Streams expected = EstimateStreams(clean);
  EXPECT_GE(expected.at("riekf").size(), kImuSamples);
  EXPECT_GE(expected.at("mekf").size(), kImuSamples);
  EXPECT_GE(expected.at("odometry").size(), 90U);  // encoders at 50 Hz
  EXPECT_TRUE(EstimateStreams(poisoned) == expected);
}

TEST(TruthLeak, AnotherSeedChangesEveryEstimate) {
  const TemporaryFolder folder;
  const Streams one = EstimateStreams(RunIn(folder.path(), BusyScenario()) / "recording.h5");
  const Streams two =
      EstimateStreams(RunIn(folder.path(), BusyScenario({"seed=4"})) / "recording.h5");
  for (const auto& [name, rows] : one) {
    ASSERT_FALSE(rows.empty());
    for (std::size_t k = 0; k < std::min(rows.size(), two.at(name).size()); ++k) {
      ASSERT_NE(rows[k], two.at(name)[k]) << name << " row " << k;
    }
  }
}

TEST(TruthLeak, ReplayOfTheMeasurementsGivesTheSameEstimates) {
  const TemporaryFolder folder;
  const Scenario scenario = BusyScenario();
  const auto recording = RunIn(folder.path(), scenario) / "recording.h5";
  const Streams expected = EstimateStreams(recording);
  EXPECT_TRUE(Replayed(recording, scenario, folder / "replayed.h5") == expected);
}

TEST(TruthLeak, ReplayNeedsNoTruthInTheRecording) {
  const TemporaryFolder folder;
  const Scenario scenario = BusyScenario({"record.truth=false"});
  const auto recording = RunIn(folder.path(), scenario) / "recording.h5";
  EXPECT_FALSE(ground_truth::RecordingReader(recording).ReadTruth().Next().has_value());
  EXPECT_TRUE(Replayed(recording, scenario, folder / "replayed.h5") == EstimateStreams(recording));
}

TEST(TruthLeak, ReplayWithAnotherBeliefDiffers) {
  const TemporaryFolder folder;
  const Scenario scenario = BusyScenario();
  const auto recording = RunIn(folder.path(), scenario) / "recording.h5";
  Scenario other = scenario;
  other.estimators.at("riekf").noise.wheel_forward_m_per_s *= 2.0;
  const Streams before = EstimateStreams(recording);
  const Streams after = Replayed(recording, other, folder / "replayed.h5");
  EXPECT_FALSE(after.at("riekf") == before.at("riekf"));
  EXPECT_TRUE(after.at("mekf") == before.at("mekf"));
}

}  // namespace
}  // namespace reckon::harness
