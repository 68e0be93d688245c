#include "reckon/harness/remarks.h"

#include <gtest/gtest.h>

namespace reckon::harness {
namespace {

using Sentences = std::vector<std::string>;

RunResult ResultOf(const std::vector<std::pair<std::string, double>>& metrics) {
  RunResult result;
  EstimatorScore& score = result.scores.emplace_back();
  score.name = "filter";
  for (const auto& [name, value] : metrics) score.metrics.Add(name, value);
  return result;
}

TEST(Remarks, SaysNothingOfAHealthyRun) {
  EXPECT_EQ(Remarks(ResultOf({{"estimate_count", 100},
                              {"accepted_wheels_count", 9999},
                              {"rejected_wheels_count", 1},  // what an honest gate rejects
                              {"refused_wheels_not_initialised_count", 20},
                              {"refused_imu_moving_count", 2}})),
            Sentences{});
}

TEST(Remarks, SaysThatAnEstimatorNeverStarted) {
  EXPECT_EQ(Remarks(ResultOf({{"estimate_count", 0}, {"refused_imu_moving_count", 200}})),
            (Sentences{"filter: it never gave an estimate",
                       "filter: 200 measurements were refused: imu_moving"}));
}

TEST(Remarks, CountsRefusals) {
  EXPECT_EQ(Remarks(ResultOf({{"estimate_count", 1}, {"refused_imu_not_finite_count", 3}})),
            (Sentences{"filter: 3 measurements were refused: imu_not_finite"}));
}

TEST(Remarks, SaysThatAGateRejectsTooMuch) {
  EXPECT_EQ(Remarks(ResultOf({{"estimate_count", 1},
                              {"accepted_wheels_count", 60},
                              {"warned_wheels_count", 10},
                              {"inflated_wheels_count", 10},
                              {"rejected_wheels_count", 20}})),
            (Sentences{"filter: its gate rejected 20.0 % of the corrections by wheels"}));
}

TEST(Remarks, SaysThatABeliefWasWidened) {
  EXPECT_EQ(
      Remarks(ResultOf(
          {{"estimate_count", 1}, {"accepted_wheels_count", 9999}, {"widened_wheels_count", 2}})),
      (Sentences{"filter: most corrections were rejected, the last by wheels: its belief was "
                 "widened, 2 in all"}));
}

TEST(Remarks, SaysThatACovarianceIsNone) {
  EXPECT_EQ(Remarks(ResultOf({{"estimate_count", 5}, {"indefinite_covariance_count", 2}})),
            (Sentences{"filter: 2 of its covariances are not positive definite"}));
}

}  // namespace
}  // namespace reckon::harness
