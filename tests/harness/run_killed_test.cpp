// What a run that was killed leaves: nothing under the final name, and a recording that can be
// read.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/run_case.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;

/// Runs in a child process, which ends itself by SIGKILL when `fraction` of the run is done.
void RunAndDie(const fs::path& out, const Scenario& scenario, double fraction) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RunOptions options;
    options.out = out;
    options.progress = [fraction](double done, double /*factor*/) {
      if (done >= fraction) kill(getpid(), SIGKILL);
    };
    RunScenario(scenario, "doomed", options);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it lived on";
}

TEST(Killed, RecordingCanBeReadAndNothingLooksFinished) {
  const testing::TemporaryFolder folder;
  const Scenario scenario = ReadScenarioText(
      "duration_s: 10\nmotion: {path: circle, radius_m: 3}\n"
      "estimators: {mine: {type: inekf}}\n",
      "doomed.yaml");
  RunAndDie(folder.path(), scenario, 0.5);

  EXPECT_FALSE(fs::exists(folder / "doomed/seed_00001"));
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder / "doomed")) left.push_back(entry.path());
  ASSERT_EQ(left.size(), 1U);
  EXPECT_NE(left[0].string().find(".part"), std::string::npos);
  EXPECT_FALSE(fs::exists(left[0] / "run.json"));

  const ground_truth::RecordingReader reader(left[0] / "recording.h5");
  EXPECT_FALSE(reader.closed());
  models::TimeNs last = -1;
  int rows = 0;
  for (auto truths = reader.ReadTruth(); const auto truth = truths.Next(); ++rows) {
    ASSERT_EQ(truth->t_ns, rows * models::TimeNs{1'000'000});
    last = truth->t_ns;
  }
  // It died at 5 s; of each stream, at most the last chunk of 1024 rows was not flushed.
  EXPECT_GE(models::Seconds(last), 5.0 - 1.024);
  EXPECT_EQ(reader.Attribute("resolved_scenario"), testing::Bytes(left[0] / "resolved.yaml"));
}

TEST(Killed, IsNoObstacleToTheNextRun) {
  const testing::TemporaryFolder folder;
  const Scenario scenario = testing::BusyScenario();
  RunAndDie(folder.path(), scenario, 0.5);
  testing::RunIn(folder.path(), scenario, "doomed");
  EXPECT_TRUE(fs::exists(folder / "doomed/seed_00003/run.json"));
}

}  // namespace
}  // namespace reckon::harness
