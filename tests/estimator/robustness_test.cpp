#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using testing_estimator::Draws;
using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::SimulatedDrive;
using testing_estimator::TimeNs;

void ExpectSound(const Estimate& e, const std::string& where) {
  ASSERT_TRUE(e.X_WB.R.allFinite() && e.X_WB.p.allFinite() && e.v_WB.allFinite()) << where;
  ASSERT_TRUE(e.gyro_bias_rad_s.allFinite() && e.accel_bias_m_s2.allFinite()) << where;
  ASSERT_LT((e.X_WB.R.transpose() * e.X_WB.R - Eigen::Matrix3d::Identity()).norm(), 1e-9) << where;
  if (!e.has_covariance) return;
  ASSERT_TRUE(e.covariance.allFinite()) << where;
  const ErrorVector scale = e.covariance.diagonal().cwiseSqrt().cwiseInverse();
  ASSERT_TRUE(scale.allFinite()) << where;
  const ErrorCovariance correlation = scale.asDiagonal() * e.covariance * scale.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<ErrorCovariance>(correlation, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .minCoeff();
  // Round-off of a correlation matrix with entries of one.
  ASSERT_GT(least, -1e-9) << where;
}

/// Replaces one number of a sample by something that hardware in distress may send.
void Break(Measurement& m, Draws& draws) {
  constexpr double kBad[] = {0.0, 1e3, -1e3, 1e300, 1e-300};
  const auto pick = static_cast<std::size_t>(draws.Uniform(0, 8));
  const double bad = pick < 5   ? kBad[pick]
                     : pick < 6 ? std::numeric_limits<double>::quiet_NaN()
                     : pick < 7 ? std::numeric_limits<double>::infinity()
                                : 50.0 * draws.Normal();
  const auto axis = static_cast<Eigen::Index>(draws.Uniform(0, 3));
  if (auto* imu = std::get_if<models::ImuSample>(&m.sample)) {
    (draws.Uniform(0, 1) < 0.5 ? imu->gyro_rad_s : imu->accel_m_s2)[axis] = bad;
    if (draws.Uniform(0, 1) < 0.2) imu->interval_ns = static_cast<TimeNs>(1e9 * draws.Normal());
  } else if (auto* velocity = std::get_if<models::BodyVelocitySample>(&m.sample)) {
    velocity->v_WS_S[axis] = bad;
    if (draws.Uniform(0, 1) < 0.3) velocity->covariance(axis, axis) = bad;
  } else {
    std::get<models::EncoderSample>(m.sample).rate_rad_s[axis] = bad;
  }
  if (draws.Uniform(0, 1) < 0.3) m.valid_ns += static_cast<TimeNs>(1e8 * draws.Normal());
  if (draws.Uniform(0, 1) < 0.02) m.valid_ns = std::numeric_limits<TimeNs>::max();
  if (draws.Uniform(0, 1) < 0.02) m.valid_ns = std::numeric_limits<TimeNs>::min();
  if (draws.Uniform(0, 1) < 0.5) m.arrival_ns = m.valid_ns;
}

class Robustness : public ::testing::TestWithParam<std::tuple<const char*, GateAction>> {};

TEST_P(Robustness, TheStateStaysSoundWhateverComesIn) {
  const auto [name, action] = GetParam();
  auto setup = testing_estimator::TestSetup();
  setup.gate.action = action;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SimulatedDrive drive(setup, seed);
    Draws draws(100 + seed);
    auto filter = Make(name, setup, drive.DrawPrior(testing_estimator::TestPrior().covariance));
    for (int i = 1; i <= 1500; ++i) {
      Measurement measurements[3] = {drive.Advance(), drive.Velocity(0.02),
                                     testing_estimator::WheelsAt(drive.t_ns(), 1, 1)};
      for (Measurement& m : measurements) {
        if (draws.Uniform(0, 1) < 0.1) continue;  // lost
        if (draws.Uniform(0, 1) < 0.05) Break(m, draws);
        (void)filter->Process(m);
      }
      if (i % 10 == 0) ExpectSound(*filter->Belief(), std::string(name) + " " + std::to_string(i));
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Filters, Robustness,
                         ::testing::Combine(::testing::Values("inekf", "mekf"),
                                            ::testing::Values(GateAction::kReject, GateAction::kOff,
                                                              GateAction::kInflate)));

TEST(Robustness, AVelocityBurstIsRejectedAndForgotten) {
  const auto setup = testing_estimator::TestSetup();
  for (const char* name : {"inekf", "mekf"}) {
    SimulatedDrive drive(setup, 3);
    auto filter = Make(name, setup, drive.DrawPrior(testing_estimator::TestPrior().covariance));
    int rejected = 0;
    for (int i = 1; i <= 2000; ++i) {
      (void)filter->Process(drive.Advance());
      if (i % 10 != 0) continue;
      Measurement velocity = drive.Velocity(0.02);
      if (i > 1000 && i <= 1200) {
        std::get<models::BodyVelocitySample>(velocity.sample).v_WS_S.x() += 100.0;
      }
      const Report report = filter->Process(velocity);
      rejected += report.corrections()[0].decision == Decision::kRejected ? 1 : 0;
    }
    EXPECT_GE(rejected, 20) << name;
    EXPECT_LE(rejected, 22) << name << ": good ones are hardly ever rejected";
    EXPECT_LT((filter->Belief()->v_WB - drive.Body().v).norm(), 0.05) << name;
  }
}

}  // namespace
}  // namespace reckon::estimator
