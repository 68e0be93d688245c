// A run is a pure function of its resolved scenario: whatever ran before, after or beside it.

#include <gtest/gtest.h>

#include <thread>

#include "harness/run_case.h"

namespace reckon::harness {
namespace {

using testing::BusyScenario;
using testing::ExpectSameFiles;
using testing::ReproducibleFiles;
using testing::RunIn;
using testing::TemporaryFolder;

Scenario OtherScenario() {
  return ReadScenarioText(
      "duration_s: 2\nseed: 8\nmotion: {path: square, side_m: 1, start_s: 0}\n"
      "estimators: {mine: {type: mekf}}\n",
      "other.yaml");
}

TEST(Repeat, SameScenarioGivesSameBytes) {
  const TemporaryFolder folder;
  ExpectSameFiles(RunIn(folder / "a", BusyScenario()), RunIn(folder / "b", BusyScenario()));
}

TEST(Repeat, AnotherSeedGivesOtherBytes) {
  const TemporaryFolder folder;
  const auto one = ReproducibleFiles(RunIn(folder.path(), BusyScenario()));
  const auto two = ReproducibleFiles(RunIn(folder.path(), BusyScenario({"seed=4"})));
  for (const auto& [name, bytes] : one) EXPECT_NE(bytes, two.at(name)) << name;
}

TEST(Repeat, OrderInOneProcessDoesNotMatter) {
  const TemporaryFolder folder;
  const auto busy_first = RunIn(folder / "ab", BusyScenario());
  const auto other_second = RunIn(folder / "ab", OtherScenario(), "other");
  const auto other_first = RunIn(folder / "ba", OtherScenario(), "other");
  const auto busy_second = RunIn(folder / "ba", BusyScenario());
  ExpectSameFiles(busy_first, busy_second);
  ExpectSameFiles(other_first, other_second);
}

TEST(Repeat, ThreadsDoNotMatter) {
  const TemporaryFolder folder;
  const auto busy = RunIn(folder / "one", BusyScenario());
  const auto other = RunIn(folder / "one", OtherScenario(), "other");
  std::filesystem::path busy_beside, other_beside;
  {
    const std::jthread a([&] { busy_beside = RunIn(folder / "two", BusyScenario()); });
    const std::jthread b([&] { other_beside = RunIn(folder / "two", OtherScenario(), "other"); });
  }
  ExpectSameFiles(busy, busy_beside);
  ExpectSameFiles(other, other_beside);
}

TEST(Repeat, ResolvedScenarioRepeatsTheRunThatWroteIt) {
  const TemporaryFolder folder;
  const auto first = RunIn(folder / "a", BusyScenario({"estimators.riekf.noise=matched"}));
  std::filesystem::create_directories(folder / "elsewhere");
  std::filesystem::copy_file(first / "resolved.yaml", folder / "elsewhere/busy.yaml");
  const Scenario resolved = ReadScenario((folder / "elsewhere/busy.yaml").string());
  ExpectSameFiles(first, RunIn(folder / "b", resolved));
}

TEST(Score, OfAnUntouchedResultGivesTheSameMetrics) {
  const TemporaryFolder folder;
  const auto result = RunIn(folder.path(), BusyScenario());
  const auto before = ReproducibleFiles(result);
  ScoreResults(result, {});
  EXPECT_TRUE(before == ReproducibleFiles(result));
}

TEST(Score, WithoutAlignmentChangesTheAbsoluteErrorAlone) {
  const TemporaryFolder folder;
  const auto result = RunIn(folder.path(), BusyScenario());
  const RunResult aligned = ScoreResults(result, {});
  const RunResult as_it_is = ScoreResults(result, {"score.align=none"});
  ASSERT_EQ(as_it_is.scores.size(), 3U);
  for (std::size_t i = 0; i < aligned.scores.size(); ++i) {
    const auto& a = aligned.scores[i].metrics;
    const auto& b = as_it_is.scores[i].metrics;
    // The initial error is drawn: its position has 1 cm, its yaw 0.01 rad.
    EXPECT_NE(a.Find("ate_position_rmse_m"), b.Find("ate_position_rmse_m"));
    EXPECT_EQ(a.Find("rpe_1m_translation_rmse"), b.Find("rpe_1m_translation_rmse"));
    EXPECT_TRUE(a.Find("rpe_1m_translation_rmse").has_value());
  }
}

TEST(Score, RefusesARecordingThatLacksWhatIsScored) {
  const TemporaryFolder folder;
  for (const char* off : {"record.truth=false", "record.estimates=false"}) {
    const auto result = RunIn(folder.path(), BusyScenario({off}));
    const auto before = ReproducibleFiles(result);
    EXPECT_THROW(ScoreResults(result, {}), std::invalid_argument) << off;
    EXPECT_TRUE(before == ReproducibleFiles(result));
  }
}

}  // namespace
}  // namespace reckon::harness
