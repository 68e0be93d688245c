#include "reckon/sim/low_pass.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

constexpr double kStep = 0.001, kCutoff = 60.0;

/// The filter after n steps of a unit step at its input, having rested at zero.
double StepResponse(int poles, int n) {
  LowPass filter(kCutoff, poles, kStep);
  filter.Step(Eigen::Vector3d::Zero());
  double y = 0.0;
  for (int i = 0; i < n; ++i) y = filter.Step(Eigen::Vector3d::UnitX()).x();
  return y;
}

// Exact at the ends of the steps: the textbook responses, with ω = 2π · 60 rad/s.
TEST(LowPass, AnswersAStepAsTheContinuousFilterDoes) {
  for (const int n : {1, 2, 5, 20, 100}) {
    const double x = 2.0 * std::numbers::pi * kCutoff * kStep * n;
    EXPECT_NEAR(StepResponse(1, n), 1.0 - std::exp(-x), 1e-13);
    const double r = x / std::numbers::sqrt2;
    EXPECT_NEAR(StepResponse(2, n), 1.0 - std::exp(-r) * (std::cos(r) + std::sin(r)), 1e-13);
  }
}

TEST(LowPass, StartsSettledAtItsFirstInputAndHasUnitGain) {
  for (const int poles : {1, 2}) {
    LowPass filter(kCutoff, poles, kStep);
    for (int n = 0; n < 1000; ++n) {
      EXPECT_LT((filter.Step({3.0, -2.0, 9.81}) - Eigen::Vector3d(3.0, -2.0, 9.81)).norm(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace reckon::sim
