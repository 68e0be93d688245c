// Static initialisation in a whole run: it needs rest, and refuses to take motion for rest.

#include <gtest/gtest.h>

#include "harness/run_case.h"

namespace reckon::harness {
namespace {

using testing::RunIn;
using testing::TemporaryFolder;

/// Five seconds with both filters starting from a rest of `rest_s`.
Scenario StaticStart(const std::string& motion, double rest_s) {
  const std::string filter =
      "initialisation: {kind: static, static_duration_s: " + std::to_string(rest_s) + "}}\n";
  return ReadScenarioText("duration_s: 5\nmotion: " + motion +
                              "\nestimators:\n  mekf: {type: mekf, " + filter +
                              "  riekf: {type: inekf, " + filter,
                          "static.yaml");
}

struct Start {
  int estimates = 0, moving = 0;
  models::TimeNs first_ns = -1;
};

/// How each estimator started, in the order of their names.
std::vector<Start> StartsOf(const Scenario& scenario) {
  const TemporaryFolder folder;
  const ground_truth::RecordingReader reader(RunIn(folder.path(), scenario, "static") /
                                             "recording.h5");
  std::vector<Start> starts(reader.estimators().size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    for (auto rows = reader.ReadEstimates(i); const auto row = rows.Next();) {
      if (starts[i].estimates++ == 0) starts[i].first_ns = row->t_ns;
    }
    for (auto rows = reader.ReadRefusals(i); const auto row = rows.Next();) {
      starts[i].moving += row->reason == estimator::Refusal::kMoving ? 1 : 0;
    }
  }
  return starts;
}

TEST(StaticStart, BeginsAfterTheRestThatItAveraged) {
  for (const Start& start : StartsOf(StaticStart("{path: stand}", 1.0))) {
    EXPECT_GT(start.estimates, 700);  // 4 s at 200 Hz
    EXPECT_NEAR(models::Seconds(start.first_ns), 1.0, 0.05);
    EXPECT_EQ(start.moving, 0);
  }
}

class StaticStartWhile : public ::testing::TestWithParam<const char*> {};

TEST_P(StaticStartWhile, DrivingNeverHappens) {
  for (const Start& start : StartsOf(StaticStart(GetParam(), 1.0))) {
    EXPECT_EQ(start.estimates, 0);
    EXPECT_GT(start.moving, 0);
  }
}

// From rest at t = 0 the robot has no second of rest. A steady straight drive on flat ground is the
// hard case: its IMU feels what it feels at rest, and only the wheels tell.
INSTANTIATE_TEST_SUITE_P(
    Motions, StaticStartWhile,
    ::testing::Values("{path: velocity_profile, start_s: 0, profile: [[0, 0.8, 0]]}",
                      "{path: velocity_profile, start_s: 0, profile: [[0, 0, 0.5]]}",
                      "{path: circle, radius_m: 3, start_s: 0}"));

TEST(StaticStart, WaitsForTheRobotToStop) {
  const auto starts = StartsOf(StaticStart(
      "{path: velocity_profile, start_s: 0, profile: [[0, 0.5, 0.3], [1.5, 0, 0]]}", 1.0));
  for (const Start& start : starts) {
    EXPECT_GT(start.moving, 0);
    EXPECT_GT(start.estimates, 0);
    // It commands a stop at 1.5 s and needs at least 0.5 s (1 m/s²) to come to one.
    EXPECT_GT(models::Seconds(start.first_ns), 2.9);
  }
}

}  // namespace
}  // namespace reckon::harness
