#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdio>

#include "estimator/forms.h"
#include "estimator/simulated_drive.h"

// Two hours at 200 Hz: nothing drifts that nobody renormalises.
namespace reckon::estimator {
namespace {

using testing_estimator::ChiSquareAt;
using testing_estimator::Draws;
using testing_estimator::kForms;
using testing_estimator::kMs;
using testing_estimator::MakeOf;
using testing_estimator::NameOf;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;

constexpr models::SensorId kDepth = 4;

Setup WithDepth() {
  estimator::Setup setup = testing_estimator::TestSetup();
  setup.suite.sensors.push_back({"depth", models::SensorKind::kDepth, {}, 200 * kMs});
  setup.noise.depth_m = 0.05;
  return setup;
}

/// Positive definite in every relation of its coordinates: the correlations, not metres beside
/// radians.
bool PositiveDefinite(const ErrorCovariance& P) {
  const ErrorVector scale = P.diagonal().cwiseSqrt().cwiseInverse();
  return P.allFinite() &&
         Eigen::LLT<ErrorCovariance>(scale.asDiagonal() * P * scale.asDiagonal()).info() ==
             Eigen::Success;
}

class LongRun : public ::testing::TestWithParam<ErrorForm> {};

TEST_P(LongRun, StaysSoundForTwoHours) {
  const estimator::Setup setup = WithDepth();
  SimulatedDrive drive(setup, 31);
  Draws draws(32);
  auto filter = MakeOf(GetParam(), setup, drive.DrawPrior(TestPrior().covariance));
  int corrections = 0, rejected = 0;
  double worst_turn = 0.0;
  for (int i = 1; i <= 2 * 3600 * 200; ++i) {
    (void)filter->Process(drive.Advance());
    if (i % 40 == 0) {
      const double depth = -drive.Body().p.z() + setup.noise.depth_m * draws.Normal();
      const models::TimeNs t = drive.t_ns();
      for (const auto& m :
           {drive.Velocity(0.02), models::Measurement{kDepth, t, t, models::DepthSample{depth}}}) {
        const Report report = filter->Process(m);
        ASSERT_EQ(report.corrections().size(), 1u);
        ++corrections;
        rejected += report.corrections()[0].decision == Decision::kRejected ? 1 : 0;
      }
    }
    if (i % 10000 != 0) continue;
    const Estimate e = *filter->Belief();
    ASSERT_TRUE(PositiveDefinite(e.covariance)) << "step " << i;
    const Eigen::Matrix3d& R = e.X_WB.R;
    worst_turn = std::max(worst_turn, (R.transpose() * R - Eigen::Matrix3d::Identity()).norm());
  }
  // Round-off: 1.44e6 products each err by some 1e-16, as a walk 2e-13.
  EXPECT_LT(worst_turn, 1e-12);
  EXPECT_EQ(corrections, 2 * 36000);
  // The gate lets one honest correction in 10,000 go.
  EXPECT_LT(rejected, 40);
  (void)filter->Process(drive.Advance());
  const Estimate e = *filter->Belief();
  const ErrorVector error = testing_estimator::ErrorOf(e, drive.Body());
  const double nees = error.dot(e.covariance.ldlt().solve(error));
  std::printf("%s: NEES %.1f of 15 after two hours, %.0f m away\n", NameOf(GetParam()).c_str(),
              nees, drive.Body().p.norm());
  // A left-invariant covariance of a position lies in the body's axes. It is not moved when a
  // correction turns those, which costs it the vertical of a position that is known to 70 m along
  // the ground and 5 cm across: it is not consistent so far away, and is not used there.
  if (GetParam() == ErrorForm::kLeftInvariant) return;
  // One in a million, both sides.
  EXPECT_GT(nees, ChiSquareAt(-4.89, 15));
  EXPECT_LT(nees, ChiSquareAt(4.89, 15));
}

INSTANTIATE_TEST_SUITE_P(Forms, LongRun, ::testing::ValuesIn(kForms),
                         [](const auto& form) { return NameOf(form.param); });

}  // namespace
}  // namespace reckon::estimator
