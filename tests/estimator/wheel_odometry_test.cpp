#include "reckon/estimator/wheel_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "estimator/robot.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::kMs;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;
using testing_estimator::TimeNs;
using testing_estimator::WheelsAt;

/// Radius 0.2 m, effective track 1 m.
Estimate After(const estimator::Setup& setup, const Prior& prior, double left, double right,
               TimeNs until) {
  WheelOdometry odometry(setup);
  odometry.Start(prior);
  for (TimeNs t = 20 * kMs; t <= until; t += 20 * kMs) {
    EXPECT_TRUE(odometry.Process(WheelsAt(t, left, right)).propagated);
  }
  return *odometry.Belief();
}

TEST(WheelOdometry, DrivesStraight) {
  Prior prior = TestPrior();
  prior.X_WB = {Exp({0, 0, M_PI / 2}), Vector3d(1, 2, 3)};
  const Estimate e = After(TestSetup(), prior, 5.0, 5.0, 3000 * kMs);  // 1 m/s for 3 s
  EXPECT_LT((e.X_WB.p - Vector3d(1, 5, 3)).norm(), 1e-12);
  EXPECT_LT((e.v_WB - Vector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_FALSE(e.has_covariance);
  EXPECT_FALSE(e.has_biases);
}

TEST(WheelOdometry, DrivesACircle) {
  // v = 0.2 · 5, yaw rate 0.2 · 5: a circle of 1 m radius; half of it in π seconds, to 4 ms.
  const Estimate e = After(TestSetup(), TestPrior(), 2.5, 7.5, 3140 * kMs);
  EXPECT_LT((e.X_WB.p - Vector3d(std::sin(3.14), 1 - std::cos(3.14), 0)).norm(), 1e-12);
  EXPECT_LT(Log(e.X_WB.R * Exp({0, 0, 3.14}).transpose()).norm(), 1e-12);
}

TEST(WheelOdometry, TurnsAboutTheDrivesCentreNotTheBodys) {
  auto setup = TestSetup();
  setup.suite.wheels->X_BS.p = {0.3, 0, 0};
  // On the spot: the drive's centre stays where it was.
  const Estimate e = After(setup, TestPrior(), -5.0, 5.0, 1000 * kMs);
  EXPECT_LT((e.X_WB * Vector3d(0.3, 0, 0) - Vector3d(0.3, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(Log(e.X_WB.R).z(), 2.0, 1e-12);
}

TEST(WheelOdometry, KeepsTheTiltOfThePrior) {
  Prior prior = TestPrior();
  prior.X_WB.R = Exp({0, -0.1, 0});
  const Estimate e = After(TestSetup(), prior, 5.0, 5.0, 1000 * kMs);
  EXPECT_LT((e.X_WB.p - Vector3d(std::cos(0.1), 0, std::sin(0.1))).norm(), 1e-12);
}

TEST(WheelOdometry, RefusesWhatItCannotUse) {
  WheelOdometry odometry(TestSetup());
  EXPECT_EQ(odometry.Process(WheelsAt(20 * kMs, 1, 1)).refusal, Refusal::kNotInitialised);
  EXPECT_FALSE(odometry.Belief());
  odometry.Start(TestPrior());
  EXPECT_EQ(odometry.Process(testing_estimator::RestingImu(5 * kMs)).refusal, Refusal::kUnused);
  EXPECT_EQ(odometry.Process(WheelsAt(20 * kMs, 1, 1)).refusal, Refusal::kNone);
  EXPECT_EQ(odometry.Process(WheelsAt(20 * kMs, 1, 1)).refusal, Refusal::kBackwards);
  EXPECT_EQ(odometry.Process(WheelsAt(40 * kMs, 1, std::nan(""))).refusal, Refusal::kNotFinite);
  EXPECT_EQ(odometry.Process(WheelsAt(61'000 * kMs, 1, 1)).refusal, Refusal::kGap);
  auto setup = TestSetup();
  setup.suite.wheels.reset();
  EXPECT_THROW(WheelOdometry{setup}, std::invalid_argument);
  setup = TestSetup();
  setup.suite.wheels->effective_track_m = 0.0;
  EXPECT_THROW(WheelOdometry{setup}, std::invalid_argument);
}

}  // namespace
}  // namespace reckon::estimator
