#include "reckon/estimator/static_initialiser.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;

constexpr double kDt = 5e-3;

Setup StaticSetup() {
  auto setup = TestSetup();
  setup.initialisation.kind = InitialisationKind::kStatic;
  return setup;
}

TEST(StaticInitialiser, FindsTiltAndGyroscopeBias) {
  StaticInitialiser rest(StaticSetup(), kDt);
  Prior prior = TestPrior();
  prior.X_WB = {Exp({0, 0, 2.0}), Vector3d(1, 2, 3)};
  rest.Start(prior);
  const Eigen::Matrix3d R = Exp({0.05, -0.08, 0}) * prior.X_WB.R;
  auto progress = StaticInitialiser::Progress::kWaiting;
  int samples = 0;
  for (; progress == StaticInitialiser::Progress::kWaiting && samples < 1000; ++samples) {
    progress = rest.Add({1e-3, -2e-3, 5e-4}, R.transpose() * Vector3d(0, 0, 9.81), kDt);
  }
  ASSERT_EQ(progress, StaticInitialiser::Progress::kDone);
  EXPECT_EQ(samples, 200) << "one second at 200 Hz";
  const Vector3d p_BI(0.2, 0, 0.1);
  const NavigationState x = rest.State(p_BI);
  EXPECT_LT((x.R - R).norm(), 1e-14) << "a turn about a horizontal axis keeps the yaw";
  EXPECT_LT((x.gyro_bias - Vector3d(1e-3, -2e-3, 5e-4)).norm(), 1e-15);
  EXPECT_LT((x.p - (prior.X_WB.p + R * p_BI)).norm(), 1e-14);
  EXPECT_EQ(x.v, Vector3d::Zero());
}

TEST(StaticInitialiser, RefusesToRunWhileMoving) {
  const Vector3d up(0, 0, 9.81);
  // Turning, shaking, accelerating: each too much for the noise and the biases believed.
  struct Motion {
    const char* name;
    Vector3d rate, force, shake_rate, shake_force;
  };
  const Vector3d none = Vector3d::Zero();
  for (const Motion& m : {Motion{"turning", {0, 0, 0.1}, up, none, none},
                          Motion{"rocking", none, up, {0.05, 0, 0}, none},
                          Motion{"shaking", none, up, none, {0, 0, 0.5}},
                          Motion{"accelerating", none, up + Vector3d(2, 0, 0), none, none}}) {
    StaticInitialiser rest(StaticSetup(), kDt);
    rest.Start(TestPrior());
    bool refused = false;
    for (int i = 0; i < 1000; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      const auto progress =
          rest.Add(m.rate + sign * m.shake_rate, m.force + sign * m.shake_force, kDt);
      EXPECT_NE(progress, StaticInitialiser::Progress::kDone) << m.name;
      refused = refused || progress == StaticInitialiser::Progress::kMoving;
    }
    EXPECT_TRUE(refused) << m.name;
  }
}

TEST(StaticInitialiser, StartsOverAfterMotion) {
  StaticInitialiser rest(StaticSetup(), kDt);
  rest.Start(TestPrior());
  const auto still = [&] { return rest.Add(Vector3d::Zero(), {0, 0, 9.81}, kDt); };
  for (int i = 0; i < 150; ++i) EXPECT_EQ(still(), StaticInitialiser::Progress::kWaiting);
  EXPECT_FALSE(rest.AddWheelRate(0.5));
  EXPECT_TRUE(rest.AddWheelRate(0.0));
  for (int i = 0; i < 199; ++i) EXPECT_EQ(still(), StaticInitialiser::Progress::kWaiting);
  EXPECT_EQ(still(), StaticInitialiser::Progress::kDone);
}

TEST(StaticInitialiser, ErrorsLieWithinTheCovarianceItGives) {
  const auto setup = StaticSetup();
  const Noise& n = setup.noise;
  constexpr int kRuns = 400;
  Draws draws(51);
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    // On a slope, with a yaw of its own, and away from the origin: at 3 m a prior tilt of 0.02 rad
    // is 6 cm of right-invariant position, and its second order still far below the prior's 1 cm.
    NavigationState truth;
    truth.R = Exp({0, 0, draws.Uniform(-3, 3)}) * Exp({0.15, -0.1, 0});
    truth.p = {3, -2, 0.5};
    Prior prior = TestPrior();
    const ErrorVector e = prior.covariance.diagonal().cwiseSqrt().cwiseProduct(draws.Normals<15>());
    const Vector3d theta = e.segment<3>(kTheta);
    prior.X_WB.R = Exp(theta) * truth.R;
    prior.X_WB.p = Exp(theta) * truth.p + LeftJacobian(theta) * e.segment<3>(kPosition);
    truth.gyro_bias = prior.gyro_bias_rad_s - e.segment<3>(kGyroBias);
    truth.accel_bias = prior.accel_bias_m_s2 - e.segment<3>(kAccelBias);
    StaticInitialiser rest(setup, kDt);
    rest.Start(prior);
    auto progress = StaticInitialiser::Progress::kWaiting;
    while (progress == StaticInitialiser::Progress::kWaiting) {
      truth.gyro_bias += draws.Vector(n.gyro_bias_walk_rad_per_s2_sqrt_hz * std::sqrt(kDt));
      const Vector3d w =
          truth.gyro_bias + draws.Vector(n.gyro_noise_density_rad_per_s_sqrt_hz / std::sqrt(kDt));
      const Vector3d a = truth.R.transpose() * Vector3d(0, 0, 9.81) + truth.accel_bias +
                         draws.Vector(n.accel_noise_density_m_per_s2_sqrt_hz / std::sqrt(kDt));
      progress = rest.Add(w, a, kDt);
    }
    ASSERT_EQ(progress, StaticInitialiser::Progress::kDone);
    const ErrorVector error =
        ErrorBetween(ErrorForm::kRightInvariant, rest.State(Vector3d::Zero()), truth);
    // Velocity is known to be zero here, and says nothing.
    const ErrorCovariance P = rest.Covariance();
    Eigen::Matrix<double, 12, 1> rest_error;
    Eigen::Matrix<double, 12, 12> rest_P;
    const int kept[] = {0, 1, 2, 6, 7, 8, 9, 10, 11, 12, 13, 14};
    for (int i = 0; i < 12; ++i) {
      rest_error[i] = error[kept[i]];
      for (int j = 0; j < 12; ++j) rest_P(i, j) = P(kept[i], kept[j]);
    }
    nees += rest_error.dot(rest_P.ldlt().solve(rest_error));
  }
  // Two-sided, one in a million.
  EXPECT_GT(nees, testing_estimator::ChiSquareAt(-4.89, 12.0 * kRuns));
  EXPECT_LT(nees, testing_estimator::ChiSquareAt(4.89, 12.0 * kRuns));
}

TEST(StaticInitialiser, StartsBothFilters) {
  for (const char* name : {"inekf", "mekf"}) {
    auto filter = testing_estimator::Make(name, StaticSetup());
    models::TimeNs t = 0;
    while (!filter->Belief() && t < 2 * models::kNsPerSecond) {
      t += 5 * testing_estimator::kMs;
      (void)filter->Process(testing_estimator::RestingImu(t));
    }
    EXPECT_EQ(t, models::kNsPerSecond) << name;
    ASSERT_TRUE(filter->Belief()) << name;
    EXPECT_EQ(filter->Belief()->t_ns, models::kNsPerSecond) << name;
    EXPECT_LT(Log(filter->Belief()->X_WB.R).norm(), 1e-12) << name;
  }
}

}  // namespace
}  // namespace reckon::estimator
