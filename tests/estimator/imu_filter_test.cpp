#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::ErrorOf;
using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::RestingImu;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;
using testing_estimator::TimeNs;
using testing_estimator::VelocityAt;
using testing_estimator::WheelsAt;

class ImuFilters : public ::testing::TestWithParam<const char*> {};

bool Settled(const Report& report) { return report.refusal == Refusal::kNone; }

/// Lets a filter rest until `until`, from one sample after `from` on.
void Rest(Estimator& filter, TimeNs from, TimeNs until) {
  for (TimeNs t = from + 5 * kMs; t <= until; t += 5 * kMs) {
    ASSERT_TRUE(Settled(filter.Process(RestingImu(t))));
  }
}

double VelocitySigma(const Estimate& e) {
  return std::sqrt(e.covariance.block<3, 3>(kVelocity, kVelocity).trace());
}

TEST_P(ImuFilters, ReproduceANoiselessMotionOfTheBody) {
  const auto setup = TestSetup();
  SimulatedDrive drive(setup, 1, 0.0);
  auto filter = Make(GetParam(), setup, drive.DrawPrior(TestPrior().covariance));
  for (int i = 0; i < 12'000; ++i) ASSERT_TRUE(Settled(filter->Process(drive.Advance())));
  const ErrorVector error = ErrorOf(*filter->Belief(), drive.Body());
  // A minute of round-off: both sides run the same recursion, one through the mounting's rotation.
  EXPECT_LT(error.segment<3>(kTheta).norm(), 1e-11);
  EXPECT_LT(error.segment<3>(kVelocity).norm(), 1e-8);
  EXPECT_LT(error.segment<3>(kPosition).norm(), 1e-6);
}

TEST_P(ImuFilters, AgreeingCorrectionsLeaveTheStateAlone) {
  const auto setup = TestSetup();
  SimulatedDrive drive(setup, 2, 0.0);
  auto filter = Make(GetParam(), setup, drive.DrawPrior(TestPrior().covariance));
  for (int i = 1; i <= 2000; ++i) {
    ASSERT_TRUE(Settled(filter->Process(drive.Advance())));
    if (i % 10 != 0) continue;
    const Report report = filter->Process(drive.Velocity(0.02));
    ASSERT_EQ(report.corrections().size(), 1u);
    // Wrong lever arms or axes would show at centimetres per second.
    EXPECT_LT(report.corrections()[0].innovation.norm(), 1e-9);
  }
  EXPECT_LT(ErrorOf(*filter->Belief(), drive.Body()).norm(), 1e-8);
}

TEST_P(ImuFilters, StartWithThePriorOfTheBody) {
  const auto setup = TestSetup();
  SimulatedDrive drive(setup, 3);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  const Estimate e = *Make(GetParam(), setup, prior)->Belief();
  EXPECT_LT((e.X_WB.R - prior.X_WB.R).norm(), 1e-15);
  EXPECT_LT((e.X_WB.p - prior.X_WB.p).norm(), 1e-14);
  EXPECT_LT((e.v_WB - prior.v_WB).norm(), 1e-14);
  EXPECT_EQ(e.t_ns, prior.t_ns);
  const ErrorCovariance P =
      ConvertForm(e.covariance, e.form, ErrorForm::kRightInvariant, testing_estimator::StateOf(e));
  for (const auto block : {kTheta, kPosition, kGyroBias, kAccelBias}) {
    const Eigen::Matrix3d difference =
        P.block<3, 3>(block, block) - Eigen::Matrix3d(prior.covariance.block<3, 3>(block, block));
    EXPECT_LT(difference.norm(), 1e-12) << block;
  }
}

TEST_P(ImuFilters, StandStillAtRest) {
  auto filter = Make(GetParam());
  Rest(*filter, 0, 1000 * kMs);
  EXPECT_LT(filter->Belief()->X_WB.p.norm(), 1e-12);
  EXPECT_LT(filter->Belief()->v_WB.norm(), 1e-12);
}

TEST_P(ImuFilters, WheelsPullTheSpeedToTheirs) {
  auto filter = Make(GetParam());
  Rest(*filter, 0, 95 * kMs);
  // 1 rad/s at a radius of 0.2 m; within the prior's 5 cm/s four times over.
  for (int i = 0; i < 50; ++i) {
    const TimeNs t = (100 + 5 * i) * kMs;
    Rest(*filter, t - 5 * kMs, t);
    const Report report = filter->Process(WheelsAt(t, 0.5, 0.5));
    ASSERT_EQ(report.corrections().size(), 1u);
    EXPECT_EQ(report.corrections()[0].decision, Decision::kAccepted);
  }
  EXPECT_NEAR(filter->Belief()->v_WB.x(), 0.1, 2e-3);
  EXPECT_NEAR(filter->Belief()->v_WB.y(), 0.0, 2e-3);
}

TEST_P(ImuFilters, ReportTheInnovationInBodyAxesAndItsNis) {
  Prior prior = TestPrior();
  prior.X_WB.R = Exp({0, 0, 1.57});
  auto filter = Make(GetParam(), TestSetup(), prior);
  const Report report = filter->Process(WheelsAt(0, 1.0, 1.0));
  ASSERT_EQ(report.corrections().size(), 1u);
  const Correction& c = report.corrections()[0];
  EXPECT_EQ(c.sensor, testing_estimator::kWheels);
  EXPECT_EQ(c.t_ns, 0);
  EXPECT_EQ(c.rows, 3);
  EXPECT_LT((c.innovation - Vector3d(0.2, 0, 0)).norm(), 1e-12);
  // Prior 0.05, forward noise 0.02, and a gyroscope bias of 1e-3 over a lever arm of 0.2 m.
  EXPECT_NEAR(c.covariance(0, 0), 0.05 * 0.05 + 0.02 * 0.02, 1e-7);
  EXPECT_NEAR(c.nis, c.innovation.dot(c.covariance.inverse() * c.innovation), 1e-9);
}

TEST_P(ImuFilters, GateRejectsWarnsOrInflates) {
  const auto after = [this](GateAction action) {
    auto setup = TestSetup();
    setup.gate.action = action;
    auto filter = Make(GetParam(), setup);
    const Report report = filter->Process(WheelsAt(0, 500.0, 500.0));  // 100 m/s
    EXPECT_EQ(report.corrections().size(), 1u);
    return std::pair(report.corrections()[0].decision, filter->Belief()->v_WB.x());
  };
  EXPECT_EQ(after(GateAction::kReject), std::pair(Decision::kRejected, 0.0));
  EXPECT_EQ(after(GateAction::kOff).first, Decision::kAccepted);
  EXPECT_GT(after(GateAction::kOff).second, 50.0);
  EXPECT_EQ(after(GateAction::kWarn).first, Decision::kWarned);
  EXPECT_EQ(after(GateAction::kWarn).second, after(GateAction::kOff).second);
  EXPECT_EQ(after(GateAction::kInflate).first, Decision::kInflated);
  // At the gate's edge z = 4.6 √S = 0.25 m/s: what can come of it is less than that.
  EXPECT_LT(after(GateAction::kInflate).second, 0.25);
  EXPECT_GT(after(GateAction::kInflate).second, 0.0);
}

TEST_P(ImuFilters, ACorrectionFromAheadWaitsForTheImu) {
  auto waiting = Make(GetParam()), punctual = Make(GetParam());
  Report report = waiting->Process(WheelsAt(10 * kMs, 0.5, 0.5));
  EXPECT_TRUE(report.corrections().empty());
  report = waiting->Process(RestingImu(5 * kMs));
  EXPECT_TRUE(report.corrections().empty());
  report = waiting->Process(RestingImu(10 * kMs));
  ASSERT_EQ(report.corrections().size(), 1u);
  EXPECT_EQ(report.corrections()[0].t_ns, 10 * kMs);
  Rest(*punctual, 0, 10 * kMs);
  EXPECT_TRUE(Settled(punctual->Process(WheelsAt(10 * kMs, 0.5, 0.5))));
  EXPECT_EQ(waiting->Belief()->v_WB, punctual->Belief()->v_WB);
  EXPECT_EQ(waiting->Belief()->covariance, punctual->Belief()->covariance);
}

TEST_P(ImuFilters, WaitingCorrectionsAreUsedAtTheirOwnTimes) {
  auto filter = Make(GetParam());
  Rest(*filter, 0, 100 * kMs);
  for (const TimeNs t : {107, 103}) (void)filter->Process(WheelsAt(t * kMs, 0, 0));
  std::vector<TimeNs> times;
  for (const TimeNs t : {105, 110}) {
    const Report report = filter->Process(RestingImu(t * kMs));
    for (const Correction& c : report.corrections()) times.push_back(c.t_ns);
  }
  EXPECT_EQ(times, (std::vector<TimeNs>{103 * kMs, 107 * kMs}));
}

TEST_P(ImuFilters, AGapIsBridgedAndWidensTheCovariance) {
  auto bridging = Make(GetParam()), whole = Make(GetParam());
  Rest(*bridging, 0, 100 * kMs);
  Rest(*whole, 0, 1305 * kMs);
  const Report report = bridging->Process(RestingImu(1305 * kMs));
  EXPECT_TRUE(report.propagated);
  EXPECT_EQ(report.bridged_ns, 1200 * kMs);
  EXPECT_EQ(bridging->Belief()->t_ns, 1305 * kMs);
  // An unseen 3 m/s² for 1.2 s on each axis, and the tilt of 0.5 rad/s under gravity beside it.
  EXPECT_GT(VelocitySigma(*bridging->Belief()), 3.0 * 1.2);
  EXPECT_LT(VelocitySigma(*whole->Belief()), 0.5);
  // It comes back as soon as it is told its speed.
  for (TimeNs t = 1305 * kMs; t < 1405 * kMs; t += 5 * kMs) {
    const Report back = bridging->Process(WheelsAt(t, 0.5, 0.5));
    ASSERT_EQ(back.corrections().size(), 1u);
    EXPECT_EQ(back.corrections()[0].decision, Decision::kAccepted);
    Rest(*bridging, t, t + 5 * kMs);
  }
  EXPECT_LT((bridging->Belief()->v_WB - bridging->Belief()->X_WB.R * Vector3d(0.1, 0, 0)).norm(),
            0.02);
}

TEST_P(ImuFilters, JitteringStampsAreNoGap) {
  auto filter = Make(GetParam());
  TimeNs last = 0;
  for (int i = 1; i <= 20; ++i) {
    last = i * 5 * kMs + (i % 2 == 0 ? 1 : -1) * kMs;
    const Report report = filter->Process(RestingImu(last));
    EXPECT_TRUE(report.propagated);
    EXPECT_EQ(report.bridged_ns, 0);
  }
  EXPECT_EQ(filter->Belief()->t_ns, last);
}

TEST_P(ImuFilters, SaturatedSamplesCountForLittle) {
  auto clean = Make(GetParam()), clipped = Make(GetParam());
  for (TimeNs t = 5 * kMs; t <= 100 * kMs; t += 5 * kMs) {
    Measurement imu = RestingImu(t);
    (void)clean->Process(imu);
    std::get<models::ImuSample>(imu.sample).accel_saturated = true;
    (void)clipped->Process(imu);
  }
  const double added =
      std::pow(VelocitySigma(*clipped->Belief()), 2) - std::pow(VelocitySigma(*clean->Belief()), 2);
  // 2e-3 m/s²/√Hz a hundredfold, on three axes for 0.1 s.
  EXPECT_NEAR(added, 3 * std::pow(100 * 2e-3, 2) * 0.1, 1e-3 * added);
}

TEST_P(ImuFilters, ABiasThatIsNotEstimatedStaysAsItWas) {
  auto setup = TestSetup();
  setup.estimate_gyro_bias = false;
  setup.estimate_accel_bias = false;
  SimulatedDrive drive(setup, 5);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  auto filter = Make(GetParam(), setup, prior);
  for (int i = 1; i <= 400; ++i) {
    (void)filter->Process(drive.Advance());
    if (i % 10 == 0) (void)filter->Process(drive.Velocity(0.02));
  }
  const Estimate e = *filter->Belief();
  EXPECT_EQ(e.gyro_bias_rad_s, prior.gyro_bias_rad_s);
  EXPECT_EQ(e.accel_bias_m_s2, prior.accel_bias_m_s2);
  EXPECT_EQ(e.covariance.bottomRows<6>().cwiseAbs().maxCoeff(), 0.0);
}

TEST_P(ImuFilters, StartingAgainIsLikeStartingNew) {
  auto used = Make(GetParam());
  Rest(*used, 0, 100 * kMs);
  (void)used->Process(WheelsAt(105 * kMs, 0.5, 0.5));  // left waiting
  used->Start(TestPrior());
  auto fresh = Make(GetParam());
  for (TimeNs t = 5 * kMs; t <= 200 * kMs; t += 5 * kMs) {
    (void)used->Process(RestingImu(t));
    (void)fresh->Process(RestingImu(t));
  }
  EXPECT_EQ(used->Belief()->covariance, fresh->Belief()->covariance);
  EXPECT_EQ(used->Belief()->v_WB, fresh->Belief()->v_WB);
}

INSTANTIATE_TEST_SUITE_P(Filters, ImuFilters, ::testing::Values("inekf", "mekf"));

TEST(ImuFilters, AgreeWithEachOtherOnSmallErrors) {
  auto setup = TestSetup();
  SimulatedDrive drive(setup, 6, 0.01);
  const ErrorCovariance P0 = TestPrior().covariance * 1e-4;
  Prior prior = drive.DrawPrior(P0 * 1e4);
  prior.covariance = P0;
  auto inekf = Make("inekf", setup, prior), mekf = Make("mekf", setup, prior);
  for (int i = 1; i <= 2000; ++i) {
    const Measurement imu = drive.Advance();
    (void)inekf->Process(imu);
    (void)mekf->Process(imu);
    if (i % 10 != 0) continue;
    const Measurement velocity = drive.Velocity(0.02);
    (void)inekf->Process(velocity);
    (void)mekf->Process(velocity);
  }
  const Estimate a = *inekf->Belief(), b = *mekf->Belief();
  // Errors of 1e-3 σ-like size differ in second order only; a wrong row would show at first.
  EXPECT_LT((a.v_WB - b.v_WB).norm(), 1e-2 * VelocitySigma(a));
  EXPECT_LT(Log(a.X_WB.R.transpose() * b.X_WB.R).norm(),
            1e-2 * std::sqrt(a.covariance.topLeftCorner<3, 3>().trace()));
  const ErrorCovariance moved =
      ConvertForm(a.covariance, a.form, b.form, testing_estimator::StateOf(a));
  EXPECT_LT((moved.diagonal() - b.covariance.diagonal())
                .cwiseQuotient(b.covariance.diagonal())
                .cwiseAbs()
                .maxCoeff(),
            1e-2);
}

}  // namespace
}  // namespace reckon::estimator
