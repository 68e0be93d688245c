#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "estimator/forms.h"
#include "estimator/simulated_drive.h"

// What has gone wrong in estimators before, one test each.
namespace reckon::estimator {
namespace {

using testing_estimator::Draws;
using testing_estimator::kMs;
using testing_estimator::MakeOf;
using testing_estimator::Measurement;
using testing_estimator::NameOf;
using testing_estimator::RestingImu;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;
using testing_estimator::TimeNs;
using testing_estimator::VelocityAt;

constexpr double kSigma = 0.02;  ///< of the velocity sensor, m/s

/// Both estimates to the last bit.
void ExpectSame(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.t_ns, b.t_ns);
  EXPECT_EQ(a.X_WB.R, b.X_WB.R);
  EXPECT_EQ(a.X_WB.p, b.X_WB.p);
  EXPECT_EQ(a.v_WB, b.v_WB);
  EXPECT_EQ(a.gyro_bias_rad_s, b.gyro_bias_rad_s);
  EXPECT_EQ(a.accel_bias_m_s2, b.accel_bias_m_s2);
  EXPECT_EQ(a.covariance, b.covariance);
}

bool IsSound(const Estimate& e) {
  const bool finite = e.X_WB.R.allFinite() && e.X_WB.p.allFinite() && e.v_WB.allFinite() &&
                      e.gyro_bias_rad_s.allFinite() && e.accel_bias_m_s2.allFinite();
  const ErrorVector scale = e.covariance.diagonal().cwiseSqrt().cwiseInverse();
  const ErrorCovariance correlation = scale.asDiagonal() * e.covariance * scale.asDiagonal();
  return finite && Eigen::LLT<ErrorCovariance>(correlation).info() == Eigen::Success;
}

class Defects : public ::testing::TestWithParam<ErrorForm> {
 protected:
  auto Filter(const estimator::Setup& setup, const Prior& prior) const {
    return MakeOf(GetParam(), setup, prior);
  }

  estimator::Setup setup_ = TestSetup();
};

TEST_P(Defects, ANumberThatIsNoneLeavesNoTrace) {
  SimulatedDrive drive(setup_, 1);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  auto clean = Filter(setup_, prior), fed = Filter(setup_, prior);
  const auto nan = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()).eval();
  int refused = 0;
  const auto feed = [&](const Measurement& m) {
    refused += fed->Process(m).refusal == Refusal::kNotFinite ? 1 : 0;
  };
  for (int i = 1; i <= 400; ++i) {
    std::vector<Measurement> now{drive.Advance()};
    if (i % 10 == 0) now.push_back(drive.Velocity(kSigma));
    Measurement gyro = now[0], accel = now[0], velocity = drive.Velocity(kSigma);
    std::get<models::ImuSample>(gyro.sample).gyro_rad_s = nan;
    std::get<models::ImuSample>(accel.sample).accel_m_s2 = nan;
    std::get<models::BodyVelocitySample>(velocity.sample).v_WS_S = nan;
    for (const Measurement& bad : {gyro, accel, velocity}) feed(bad);
    for (const Measurement& m : now) {
      (void)clean->Process(m);
      (void)fed->Process(m);
    }
  }
  EXPECT_EQ(refused, 1200);
  ExpectSame(*clean->Belief(), *fed->Belief());
  EXPECT_TRUE(IsSound(*fed->Belief()));
}

TEST_P(Defects, TheStatesTimeNeverGoesBack) {
  SimulatedDrive drive(setup_, 2);
  auto filter = Filter(setup_, drive.DrawPrior(TestPrior().covariance));
  Draws draws(3);
  std::vector<Measurement> sent;
  TimeNs newest = 0;
  int backwards = 0;
  for (int i = 1; i <= 1000; ++i) {
    sent.push_back(drive.Advance());
    (void)filter->Process(sent.back());
    if (i % 10 == 0) (void)filter->Process(drive.Velocity(kSigma));
    // A sample of the past with a stamp of its own: time would have to go back for it.
    Measurement again = sent[static_cast<std::size_t>(draws.Uniform(0, i))];
    again.valid_ns -= 1 * kMs;
    const Report report = filter->Process(again);
    EXPECT_EQ(report.refusal, Refusal::kBackwards) << Name(report.refusal);
    EXPECT_FALSE(report.propagated);
    backwards += report.refusal == Refusal::kBackwards ? 1 : 0;
    ASSERT_GE(filter->Belief()->t_ns, newest);
    newest = filter->Belief()->t_ns;
    ASSERT_EQ(newest, drive.t_ns());
  }
  EXPECT_EQ(backwards, 1000);
}

TEST_P(Defects, AnOutlierOf100MetresPerSecondIsRejectedAndCounted) {
  SimulatedDrive drive(setup_, 4);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  auto clean = Filter(setup_, prior), fed = Filter(setup_, prior);
  int outliers = 0, rejected = 0;
  for (int i = 1; i <= 1000; ++i) {
    const Measurement imu = drive.Advance();
    (void)clean->Process(imu);
    (void)fed->Process(imu);
    if (i % 10 != 0) continue;
    Measurement velocity = drive.Velocity(kSigma);
    if (i % 100 == 0) {
      std::get<models::BodyVelocitySample>(velocity.sample).v_WS_S[(i / 100) % 3] += 100.0;
      ++outliers;
    } else {
      (void)clean->Process(velocity);
    }
    const Report report = fed->Process(velocity);
    ASSERT_EQ(report.corrections().size(), 1u);
    const bool out = report.corrections()[0].decision == Decision::kRejected;
    EXPECT_EQ(out, i % 100 == 0);
    // 100 m/s against centimetres.
    if (out) {
      EXPECT_GT(report.corrections()[0].nis, 1e4);
    }
    rejected += out ? 1 : 0;
  }
  EXPECT_EQ(rejected, outliers);
  ExpectSame(*clean->Belief(), *fed->Belief());
}

TEST_P(Defects, WithoutAGateTheSameOutlierGetsIn) {
  // Negative control of the test above.
  setup_.gate.action = GateAction::kOff;
  SimulatedDrive drive(setup_, 4);
  auto filter = Filter(setup_, drive.DrawPrior(TestPrior().covariance));
  (void)filter->Process(drive.Advance());
  Measurement velocity = drive.Velocity(kSigma);
  std::get<models::BodyVelocitySample>(velocity.sample).v_WS_S.x() += 100.0;
  const Report report = filter->Process(velocity);
  EXPECT_EQ(report.corrections()[0].decision, Decision::kAccepted);
  EXPECT_GT((filter->Belief()->v_WB - drive.Body().v).norm(), 10.0);
}

/// Whether each axis of the position's error lies within three sigmas.
bool PositionWithinThreeSigma(const Estimate& e, const NavigationState& truth) {
  // In W: the multiplicative form's own coordinates.
  const NavigationState x = testing_estimator::StateOf(e);
  const ErrorCovariance P = ConvertForm(e.covariance, e.form, ErrorForm::kMultiplicative, x);
  const Eigen::Vector3d sigma = P.diagonal().segment<3>(kPosition).cwiseSqrt();
  return ((e.X_WB.p - truth.p).cwiseAbs().array() <= 3.0 * sigma.array()).all();
}

TEST_P(Defects, AnImuGapOf1200MillisecondsIsBridgedAndCounted) {
  // Twelve drives, with velocities that go on through the gap or not. Of a gap's motion the filter
  // believes far more than these drives' 1 m/s², so that all of them end it within three sigmas.
  // What comes after it is a large error of tilt: there only the right-invariant form keeps its
  // word, the others are consistent for small errors alone.
  const bool always = GetParam() == ErrorForm::kRightInvariant;
  for (const bool velocities : {false, true}) {
    for (std::uint64_t seed = 20; seed < 32; ++seed) {
      SimulatedDrive drive(setup_, seed);
      auto filter = Filter(setup_, drive.DrawPrior(TestPrior().covariance));
      TimeNs bridged = 0;
      Estimate before, after;
      for (int i = 1; i <= 1200; ++i) {
        const Measurement imu = drive.Advance();
        const bool gap = i > 400 && i <= 640;
        if (i == 400) before = *filter->Belief();
        if (!gap) bridged += filter->Process(imu).bridged_ns;
        if (i % 10 == 0 && (!gap || velocities)) (void)filter->Process(drive.Velocity(kSigma));
        if (i == 641) after = *filter->Belief();
        if (i <= 640 || (i > 641 && !always)) continue;
        ASSERT_TRUE(PositionWithinThreeSigma(*filter->Belief(), drive.Body()))
            << "sample " << i << ", seed " << seed << ", velocities " << velocities << "; error "
            << (filter->Belief()->X_WB.p - drive.Body().p).transpose();
      }
      EXPECT_EQ(bridged, 1200 * kMs);
      EXPECT_EQ(after.t_ns, 641 * 5 * kMs);
      // At 3 m/s² and 3 m/s nothing comes further than 6 m in that time.
      EXPECT_LT((after.X_WB.p - before.X_WB.p).norm(), 6.0);
    }
  }
}

TEST_P(Defects, AVelocity120MillisecondsLateGivesThePunctualBelief) {
  SimulatedDrive drive(setup_, 5);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  auto punctual = Filter(setup_, prior), late = Filter(setup_, prior);
  Measurement travelling;
  for (int i = 1; i <= 400; ++i) {
    const Measurement imu = drive.Advance();
    (void)punctual->Process(imu);
    (void)late->Process(imu);
    if (i % 40 == 0) {
      travelling = drive.Velocity(kSigma);
      (void)punctual->Process(travelling);
      EXPECT_NE(punctual->Belief()->v_WB, late->Belief()->v_WB) << "or this shows nothing";
      travelling.arrival_ns += 120 * kMs;
    }
    if (i < 64 || i % 40 != 24) continue;
    ASSERT_EQ(drive.t_ns(), travelling.arrival_ns);
    EXPECT_EQ(late->Process(travelling).refusal, Refusal::kNone);
    ExpectSame(*punctual->Belief(), *late->Belief());
  }
}

TEST_P(Defects, StaticInitialisationOfNothingStartsNothing) {
  setup_.initialisation.kind = InitialisationKind::kStatic;
  setup_.initialisation.static_duration_s = 0.0;
  EXPECT_THROW(Filter(setup_, TestPrior()), std::invalid_argument);
  // Nearly nothing: whatever it takes, what is believed then is sound.
  for (const double seconds : {1e-9, 1e-3, 5e-3, 1e-2}) {
    setup_.initialisation.static_duration_s = seconds;
    auto filter = Filter(setup_, TestPrior());
    EXPECT_FALSE(filter->Belief().has_value()) << "no samples";
    EXPECT_EQ(filter->Process(RestingImu(5 * kMs)).refusal, Refusal::kNotInitialised);
    EXPECT_FALSE(filter->Belief().has_value()) << "one sample has no scatter";
    for (TimeNs t = 10 * kMs; t <= 200 * kMs; t += 5 * kMs) {
      (void)filter->Process(RestingImu(t));
      const auto belief = filter->Belief();
      ASSERT_TRUE(!belief || IsSound(*belief)) << seconds << " s, at " << t;
    }
    EXPECT_TRUE(filter->Belief().has_value());
  }
}

/// The yaw bias of a body with an error of `error_rad_s` in it, and its sigma, after a minute.
struct YawBias {
  double error, sigma;
};
YawBias YawBiasAfterAMinute(ErrorForm form, const estimator::Setup& setup, bool moves) {
  const double prior_sigma = 1e-2;
  SimulatedDrive drive(setup, 6);
  Prior prior = moves ? drive.DrawPrior(TestPrior().covariance) : TestPrior();
  const double truth = moves ? drive.Body().gyro_bias.z() : 0.0;
  prior.gyro_bias_rad_s.z() = truth + 2.0 * prior_sigma;
  prior.covariance(kGyroBias + 2, kGyroBias + 2) = prior_sigma * prior_sigma;
  auto filter = MakeOf(form, setup, prior);
  for (int i = 1; i <= 12000; ++i) {
    (void)filter->Process(moves ? drive.Advance() : RestingImu(i * 5 * kMs));
    if (i % 10 != 0) continue;
    (void)filter->Process(moves ? drive.Velocity(kSigma)
                                : VelocityAt(i * 5 * kMs, Eigen::Vector3d::Zero()));
  }
  const Estimate e = *filter->Belief();
  const double bias = moves ? drive.Body().gyro_bias.z() : 0.0;
  return {std::abs(e.gyro_bias_rad_s.z() - bias),
          std::sqrt(e.covariance(kGyroBias + 2, kGyroBias + 2))};
}

TEST_P(Defects, TheYawBiasIsEstimated) {
  // d(Rᵀv)/dt = a − ω × Rᵀv + Rᵀg: a bias of ω shows as an acceleration in proportion to the speed,
  // and one of a as a constant one, so that a speed that changes tells the two apart; the lever arm
  // of the sensor shows ω itself.
  const YawBias found = YawBiasAfterAMinute(GetParam(), setup_, true);
  EXPECT_LT(found.error, 0.25e-2) << "a quarter of the prior's sigma";
  EXPECT_LT(found.sigma, 0.25e-2);
  EXPECT_LT(found.error, 4.0 * found.sigma);
}

TEST_P(Defects, TheYawBiasOfARobotAtRestWithoutALeverArmIsNot) {
  // Negative control: nothing shows it, and the filter knows.
  setup_.suite.sensors[testing_estimator::kVelocity].X_BS.p =
      setup_.suite.sensors[testing_estimator::kImu].X_BS.p;
  const YawBias found = YawBiasAfterAMinute(GetParam(), setup_, false);
  EXPECT_GT(found.error, 1.9e-2);
  EXPECT_GT(found.sigma, 0.95e-2);
}

TEST_P(Defects, ADuplicateIsRefused) {
  SimulatedDrive drive(setup_, 7);
  auto filter = Filter(setup_, drive.DrawPrior(TestPrior().covariance));
  for (int i = 1; i <= 40; ++i) {
    const Measurement imu = drive.Advance(), velocity = drive.Velocity(kSigma);
    for (const Measurement& m : {imu, velocity}) {
      ASSERT_EQ(filter->Process(m).refusal, Refusal::kNone);
      const Estimate before = *filter->Belief();
      const Report report = filter->Process(m);
      EXPECT_EQ(report.refusal, Refusal::kDuplicate) << Name(report.refusal);
      EXPECT_TRUE(report.corrections().empty());
      ExpectSame(*filter->Belief(), before);
    }
  }
}

TEST_P(Defects, ACorrectionFrom100SecondsAheadChangesNothing) {
  SimulatedDrive drive(setup_, 8);
  const Prior prior = drive.DrawPrior(TestPrior().covariance);
  auto clean = Filter(setup_, prior), fed = Filter(setup_, prior);
  for (int i = 1; i <= 600; ++i) {
    const Measurement imu = drive.Advance(), velocity = drive.Velocity(kSigma);
    for (const Measurement& m : {imu, velocity}) {
      (void)clean->Process(m);
      (void)fed->Process(m);
    }
    Measurement ahead = VelocityAt(drive.t_ns() + 100'000 * kMs, {0, 0, 0});
    EXPECT_EQ(fed->Process(ahead).refusal, Refusal::kFromFuture) << "arrives when it is valid";
    ahead.arrival_ns = drive.t_ns();
    EXPECT_EQ(fed->Process(ahead).refusal, Refusal::kFromFuture) << "arrives before it is valid";
    ExpectSame(*clean->Belief(), *fed->Belief());
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, Defects, ::testing::ValuesIn(testing_estimator::kForms),
                         [](const auto& form) { return NameOf(form.param); });

}  // namespace
}  // namespace reckon::estimator
