#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/log_case.h"
#include "harness/run_case.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/replay_input.h"

namespace reckon::harness {
namespace {

using testing::BusyScenario;
using testing::RunIn;
using testing::TemporaryFolder;
using testing::WriteFile;
using testing::WriteStandingLog;

RunResult RunReplay(const std::filesystem::path& path, const std::filesystem::path& out,
                    const std::vector<std::string>& overrides = {}) {
  RunOptions options;
  options.out = out;
  return RunScenario(ReadReplay(path, overrides), ReplayName(path), options);
}

TEST(Replay, OfARunGivesItsScoresAgain) {
  const TemporaryFolder folder;
  const auto run = RunIn(folder / "out", BusyScenario());
  const RunResult again = RunReplay(run, folder / "out");
  EXPECT_EQ(again.scenario, "replay/busy");
  EXPECT_EQ(testing::Bytes(run / "riekf.tum"), testing::Bytes(again.folder / "riekf.tum"));
  EXPECT_EQ(testing::Bytes(run / "metrics.json"), testing::Bytes(again.folder / "metrics.json"));
}

TEST(Replay, TakesOtherEstimatorsOverTheSameMeasurements) {
  const TemporaryFolder folder;
  const auto run = RunIn(folder / "out", BusyScenario());
  const RunResult other = RunReplay(run, folder / "out",
                                    {"estimators.biased={type: inekf, estimate_gyro_bias: false}"});
  ASSERT_EQ(other.scores.size(), 4u);
  EXPECT_EQ(testing::Bytes(run / "riekf.tum"), testing::Bytes(other.folder / "riekf.tum"));
  EXPECT_TRUE(testing::Bytes(run / "riekf.tum") != testing::Bytes(other.folder / "biased.tum"));
}

TEST(Replay, OfALogScoresAgainstItsTruth) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "stands");
  const RunResult result = RunReplay(folder / "stands", folder / "out",
                                     {"initial.sample_error=false", "score.align=none"});
  EXPECT_EQ(result.scenario, "logs/stands");
  EXPECT_EQ(result.outcome, Outcome::kFinished);
  ASSERT_EQ(result.scores.size(), 1u);
  const auto& metrics = result.scores[0].metrics;
  EXPECT_LT(*metrics.Find("ate_position_rmse_m"), 1e-9) << "a perfect IMU and depth that agrees";
  EXPECT_EQ(*metrics.Find("nis_depth_dof"), 1.0);
  EXPECT_LT(*metrics.Find("nis_depth_mean"), 1e-9);
  EXPECT_EQ(*metrics.Find("estimate_count"), 11.0) << "ten samples and the start";
  EXPECT_FALSE(metrics.Find("gyro_bias_error_rmse_rad_s")) << "nobody knows the true biases";
}

TEST(Replay, AWrongLeverArmOfTheLogShows) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "stands");
  std::string text = testing::Bytes(folder / "stands" / "log.yaml");
  text.replace(text.find("[0, 0, -2]"), 10, "[0, 0, -1]");
  WriteFile(folder / "stands" / "log.yaml", text);
  const RunResult result = RunReplay(folder / "stands", folder / "out",
                                     {"initial.sample_error=false", "score.align=none"});
  // A metre, at 0.1 m: the gate rejects what is 98 of 1.
  EXPECT_GT(*result.scores[0].metrics.Find("nis_depth_mean"), 50.0);
}

TEST(Replay, WithoutTruthThereIsNoScore) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "stands");
  std::string text = testing::Bytes(folder / "stands" / "log.yaml");
  text.replace(text.find("truth: truth.csv"), 16, "start: {position_m: [1, 2, -5]}");
  WriteFile(folder / "stands" / "log.yaml", text);
  const RunResult result = RunReplay(folder / "stands", folder / "out");
  EXPECT_EQ(result.outcome, Outcome::kFinished);
  EXPECT_EQ(result.exit_code(), 0);
  EXPECT_FALSE(result.scores[0].metrics.Find("ate_position_rmse_m"));
  EXPECT_TRUE(result.scores[0].metrics.Find("nis_depth_mean"));
}

TEST(Replay, RefusesWhatIsNoLog) {
  const TemporaryFolder folder;
  EXPECT_THROW(ReadReplay(folder / "none", {}), LogMissing);
  WriteFile(folder / "plain.yaml", "duration_s: 1\n");
  EXPECT_THROW(ReadReplay(folder / "plain.yaml", {}), InputError);
  WriteStandingLog(folder / "stands");
  const auto log = "log: " + (folder / "stands").string() + "\n";
  EXPECT_THROW(ReadScenarioText(log + "duration_s: 1\n", "a.yaml"), InputError);
  EXPECT_THROW(ReadScenarioText(log + "estimators: {a: {noise: matched}}\n", "a.yaml"), InputError);
}

}  // namespace
}  // namespace reckon::harness
