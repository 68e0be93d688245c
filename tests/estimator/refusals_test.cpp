#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "estimator/robot.h"

namespace reckon::estimator {
namespace {

using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::RestingImu;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;
using testing_estimator::TimeNs;
using testing_estimator::VelocityAt;
using testing_estimator::WheelsAt;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Both filters take and refuse alike: every test here runs on each.
class Refusals : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    filter_ = Make(GetParam());
    for (TimeNs t = 5 * kMs; t <= 100 * kMs; t += 5 * kMs) {
      ASSERT_EQ(Send(RestingImu(t)), Refusal::kNone);
    }
  }
  Refusal Send(const Measurement& measurement) { return filter_->Process(measurement).refusal; }

  /// Expects `reason`, and that the belief stays as it was.
  void ExpectRefused(const Measurement& measurement, Refusal reason) {
    const Estimate before = *filter_->Belief();
    const Report report = filter_->Process(measurement);
    EXPECT_EQ(report.refusal, reason) << Name(report.refusal);
    EXPECT_FALSE(report.propagated);
    EXPECT_TRUE(report.corrections().empty());
    const Estimate after = *filter_->Belief();
    EXPECT_EQ(after.t_ns, before.t_ns);
    EXPECT_EQ(after.v_WB, before.v_WB);
    EXPECT_EQ(after.covariance, before.covariance);
  }

  std::unique_ptr<Estimator> filter_;
};

TEST_P(Refusals, ADepthThatNoNoiseIsBelievedOf) {
  estimator::Setup setup = TestSetup();
  setup.suite.sensors.push_back({"depth", models::SensorKind::kDepth, {}, 100 * kMs});
  const Measurement depth{4, 0, 0, models::DepthSample{1.0}};
  filter_ = Make(GetParam(), setup);
  ExpectRefused(depth, Refusal::kUnused);
  setup.noise.depth_m = 0.1;
  const Report report = Make(GetParam(), setup)->Process(depth);
  EXPECT_EQ(report.corrections().size(), 1u);
}

TEST_P(Refusals, NumbersThatAreNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    Measurement imu = RestingImu(105 * kMs);
    std::get<models::ImuSample>(imu.sample).gyro_rad_s.y() = bad;
    ExpectRefused(imu, Refusal::kNotFinite);
    imu = RestingImu(105 * kMs);
    std::get<models::ImuSample>(imu.sample).accel_m_s2.z() = bad;
    ExpectRefused(imu, Refusal::kNotFinite);
    ExpectRefused(WheelsAt(100 * kMs, 0.0, bad), Refusal::kNotFinite);
    ExpectRefused(VelocityAt(100 * kMs, {0, 0, bad}), Refusal::kNotFinite);
    ExpectRefused(VelocityAt(100 * kMs, {0, 0, 0}, bad), Refusal::kNotFinite);
  }
}

TEST_P(Refusals, TimeThatGoesBackwards) {
  ExpectRefused(RestingImu(98 * kMs), Refusal::kBackwards);
  ExpectRefused(RestingImu(1 * kMs), Refusal::kBackwards);
}

TEST_P(Refusals, SamplesThatWereSentBefore) {
  ExpectRefused(RestingImu(100 * kMs), Refusal::kDuplicate);
  ExpectRefused(RestingImu(95 * kMs), Refusal::kDuplicate);
  for (const TimeNs t : {100 * kMs, 93 * kMs, 103 * kMs}) {  // used, late, waiting
    EXPECT_EQ(Send(WheelsAt(t, 0, 0)), Refusal::kNone);
    ExpectRefused(WheelsAt(t, 0.5, 0.5), Refusal::kDuplicate);
  }
}

TEST_P(Refusals, CorrectionsOlderThanTheHistory) {
  for (TimeNs t = 105 * kMs; t <= 1000 * kMs; t += 5 * kMs)
    ASSERT_EQ(Send(RestingImu(t)), Refusal::kNone);
  ExpectRefused(WheelsAt(499 * kMs, 0, 0), Refusal::kLate);
  EXPECT_EQ(Send(WheelsAt(500 * kMs, 0, 0)), Refusal::kNone);
}

TEST_P(Refusals, WithoutAHistoryOnlyWhatTravelsLongerThanImuSamplesIsLate) {
  auto setup = TestSetup();
  setup.history_s = 0.0;
  filter_ = Make(GetParam(), setup);
  for (TimeNs t = 5 * kMs; t <= 100 * kMs; t += 5 * kMs)
    ASSERT_EQ(Send(RestingImu(t)), Refusal::kNone);
  ExpectRefused(WheelsAt(84 * kMs, 0, 0), Refusal::kLate);
  EXPECT_EQ(Send(WheelsAt(85 * kMs, 0, 0)), Refusal::kNone);
}

TEST_P(Refusals, StampsFromTheFuture) {
  Measurement wheels = WheelsAt(100 * kMs, 0, 0);
  wheels.arrival_ns = 99 * kMs;
  ExpectRefused(wheels, Refusal::kFromFuture);
  Measurement imu = RestingImu(105 * kMs);
  imu.arrival_ns = 104 * kMs;
  ExpectRefused(imu, Refusal::kFromFuture);
  ExpectRefused(WheelsAt(100 * kMs + models::kNsPerSecond + 1, 0, 0), Refusal::kFromFuture);
}

TEST_P(Refusals, MoreWaitingCorrectionsThanOneReportHolds) {
  constexpr int kMostWaiting = kMaxCorrections - 2;  // a standstill may add two
  for (int i = 0; i < kMostWaiting; ++i) {
    EXPECT_EQ(Send(WheelsAt((101 + i) * kMs, 0, 0)), Refusal::kNone);
  }
  ExpectRefused(WheelsAt(118 * kMs, 0, 0), Refusal::kFromFuture);
  Measurement imu = RestingImu(120 * kMs);
  std::get<models::ImuSample>(imu.sample).interval_ns = 20 * kMs;
  const Report report = filter_->Process(imu);
  EXPECT_EQ(report.corrections().size(), kMostWaiting);
}

TEST_P(Refusals, IntervalsAndGapsTooLongToIntegrate) {
  Measurement imu = RestingImu(105 * kMs);
  std::get<models::ImuSample>(imu.sample).interval_ns = 1001 * kMs;
  ExpectRefused(imu, Refusal::kGap);
  ExpectRefused(RestingImu(60'101 * kMs), Refusal::kGap);
  // A broken clock at the end of time.
  ExpectRefused(RestingImu(std::numeric_limits<TimeNs>::max()), Refusal::kGap);
  ExpectRefused(WheelsAt(std::numeric_limits<TimeNs>::max(), 0, 0), Refusal::kFromFuture);
}

TEST_P(Refusals, MalformedSamples) {
  Measurement imu = RestingImu(105 * kMs);
  for (const TimeNs interval : {TimeNs{0}, TimeNs{-5 * kMs}}) {
    std::get<models::ImuSample>(imu.sample).interval_ns = interval;
    ExpectRefused(imu, Refusal::kInvalid);
  }
  Measurement three = WheelsAt(100 * kMs, 0, 0);
  std::get<models::EncoderSample>(three.sample).rate_rad_s = Eigen::Vector3d::Zero();
  ExpectRefused(three, Refusal::kInvalid);
  std::get<models::EncoderSample>(three.sample).angle_rad = Eigen::Vector3d::Zero();
  ExpectRefused(three, Refusal::kInvalid);
  Measurement velocity = VelocityAt(100 * kMs, {0, 0, 0});
  std::get<models::BodyVelocitySample>(velocity.sample).covariance(0, 0) = -1.0;
  ExpectRefused(velocity, Refusal::kInvalid);
  std::get<models::BodyVelocitySample>(velocity.sample).covariance.setIdentity()(0, 1) = 0.5;
  ExpectRefused(velocity, Refusal::kInvalid);
  Measurement stranger = RestingImu(105 * kMs);
  stranger.sensor = 99;
  ExpectRefused(stranger, Refusal::kInvalid);
  stranger.sensor = testing_estimator::kWheels;
  ExpectRefused(stranger, Refusal::kInvalid);
  ExpectRefused(WheelsAt(std::numeric_limits<TimeNs>::min(), 0, 0), Refusal::kInvalid);
}

TEST_P(Refusals, SensorsThatTheFilterHasNoUseFor) {
  Measurement spare = RestingImu(105 * kMs);
  spare.sensor = testing_estimator::kSecondImu;
  ExpectRefused(spare, Refusal::kUnused);
}

TEST_P(Refusals, NothingIsBelievedBeforeStaticInitialisationIsThrough) {
  auto setup = TestSetup();
  setup.initialisation.kind = InitialisationKind::kStatic;
  filter_ = Make(GetParam(), setup);
  EXPECT_FALSE(filter_->Belief());
  EXPECT_EQ(Send(RestingImu(5 * kMs)), Refusal::kNotInitialised);
  EXPECT_EQ(Send(WheelsAt(5 * kMs, 0, 0)), Refusal::kNotInitialised);
  EXPECT_EQ(Send(WheelsAt(5 * kMs, 1, 0)), Refusal::kMoving);
  EXPECT_FALSE(filter_->Belief());
}

TEST_P(Refusals, SetupsThatNoFilterCanWorkWith) {
  const auto refuses = [this](const auto& spoil) {
    auto setup = TestSetup();
    spoil(setup);
    EXPECT_THROW(Make(GetParam(), setup), std::invalid_argument);
  };
  refuses([](estimator::Setup& s) { s.suite.sensors.clear(); });
  refuses([](estimator::Setup& s) { s.suite.sensors[0].period_ns = 0; });
  refuses([](estimator::Setup& s) { s.noise.gyro_noise_density_rad_per_s_sqrt_hz = -1e-4; });
  refuses([](estimator::Setup& s) { s.noise.wheel_forward_m_per_s = kNan; });
  refuses([](estimator::Setup& s) { s.gate.probability = 1.0; });
  refuses([](estimator::Setup& s) { s.gravity_m_s2 = 0.0; });
  refuses([](estimator::Setup& s) { s.suite.wheels->left.clear(); });
  refuses([](estimator::Setup& s) { s.suite.wheels->right = {-1}; });
  refuses([](estimator::Setup& s) { s.suite.wheels->encoders = "imu"; });
  refuses([](estimator::Setup& s) {
    s.initialisation.kind = InitialisationKind::kStatic;
    s.initialisation.static_duration_s = 0.0;
  });
  Prior prior = TestPrior();
  prior.v_WB.x() = kNan;
  EXPECT_THROW(Make(GetParam(), TestSetup(), prior), std::invalid_argument);
  prior = TestPrior();
  prior.X_WB.R *= 1.1;
  EXPECT_THROW(Make(GetParam(), TestSetup(), prior), std::invalid_argument);
  prior = TestPrior();
  prior.covariance(0, 0) = -1.0;
  EXPECT_THROW(Make(GetParam(), TestSetup(), prior), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Filters, Refusals, ::testing::Values("inekf", "mekf"));

}  // namespace
}  // namespace reckon::estimator
