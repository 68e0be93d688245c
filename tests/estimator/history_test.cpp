#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using testing_estimator::Draws;
using testing_estimator::ErrorOf;
using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::RestingImu;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;
using testing_estimator::TimeNs;
using testing_estimator::WheelsAt;

/// Both estimates to the last bit.
void ExpectSame(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.t_ns, b.t_ns);
  EXPECT_EQ(a.X_WB.R, b.X_WB.R);
  EXPECT_EQ(a.X_WB.p, b.X_WB.p);
  EXPECT_EQ(a.v_WB, b.v_WB);
  EXPECT_EQ(a.gyro_bias_rad_s, b.gyro_bias_rad_s);
  EXPECT_EQ(a.covariance, b.covariance);
}

class History : public ::testing::TestWithParam<const char*> {
 protected:
  /// `seconds` of a drive: IMU at 200 Hz, velocities at 20 Hz between the samples' stamps.
  std::vector<Measurement> Drive(double seconds) {
    SimulatedDrive drive(setup_, 11);
    prior_ = drive.DrawPrior(TestPrior().covariance);
    std::vector<Measurement> all;
    for (int i = 1; i <= static_cast<int>(200 * seconds); ++i) {
      all.push_back(drive.Advance());
      if (i % 10 != 0) continue;
      Measurement velocity = drive.Velocity(0.02);
      velocity.valid_ns -= 2 * kMs;  // no two of one stamp
      all.push_back(velocity);
    }
    std::stable_sort(all.begin(), all.end(), [](const Measurement& a, const Measurement& b) {
      return a.valid_ns < b.valid_ns;
    });
    return all;
  }

  /// Sends all in the order of their arrival; how many corrections were reported.
  std::size_t Send(Estimator& filter, std::vector<Measurement> all) const {
    std::stable_sort(all.begin(), all.end(), [](const Measurement& a, const Measurement& b) {
      return a.arrival_ns < b.arrival_ns;
    });
    std::size_t corrections = 0;
    for (const Measurement& m : all) {
      const Report report = filter.Process(m);
      EXPECT_EQ(report.refusal, Refusal::kNone) << Name(report.refusal);
      corrections += report.corrections().size();
    }
    return corrections;
  }

  estimator::Setup setup_ = TestSetup();
  Prior prior_;
};

TEST_P(History, LateAndOutOfOrderMeasurementsAreAsGoodAsPunctualOnes) {
  const auto punctual = Drive(3.0);
  auto late = punctual;
  Draws draws(5);
  for (Measurement& m : late) {
    const bool imu = std::holds_alternative<models::ImuSample>(m.sample);
    if (!imu) m.arrival_ns = m.valid_ns + static_cast<TimeNs>(draws.Uniform(0, 400) * kMs);
  }
  // The last may not arrive before the run's end.
  auto a = Make(GetParam(), setup_, prior_), b = Make(GetParam(), setup_, prior_);
  const std::size_t corrections = Send(*a, punctual);
  EXPECT_EQ(corrections, 60u);
  EXPECT_EQ(Send(*b, late), corrections) << "each is reported once";
  ExpectSame(*a->Belief(), *b->Belief());
  // Punctual and late differ while the late ones travel, or this shows nothing.
  auto c = Make(GetParam(), setup_, prior_);
  for (const Measurement& m : punctual) {
    if (m.valid_ns < 2700 * kMs || std::holds_alternative<models::ImuSample>(m.sample)) {
      (void)c->Process(m);
    }
  }
  EXPECT_NE(c->Belief()->v_WB, a->Belief()->v_WB);
}

TEST_P(History, AnImuSampleThatComesLateFillsItsGap) {
  const auto punctual = Drive(1.0);
  auto late = punctual;
  for (Measurement& m : late) {
    const bool imu = std::holds_alternative<models::ImuSample>(m.sample);
    if (imu && (m.valid_ns == 300 * kMs || m.valid_ns == 500 * kMs)) m.arrival_ns += 57 * kMs;
  }
  auto a = Make(GetParam(), setup_, prior_), b = Make(GetParam(), setup_, prior_);
  (void)Send(*a, punctual);
  (void)Send(*b, late);
  ExpectSame(*a->Belief(), *b->Belief());
}

TEST_P(History, TellsTheBeliefOfAnyTime) {
  const auto all = Drive(1.0);
  auto filter = Make(GetParam(), setup_, prior_);
  (void)Send(*filter, all);
  for (const TimeNs t : {600 * kMs, 743 * kMs, 803 * kMs}) {
    auto then = Make(GetParam(), setup_, prior_);
    for (const Measurement& m : all) {
      // All that is true until then, and the sample that covers it, which is cut there.
      const auto* imu = std::get_if<models::ImuSample>(&m.sample);
      Measurement cut = m;
      if (imu != nullptr && m.valid_ns > t && m.valid_ns - imu->interval_ns < t) {
        std::get<models::ImuSample>(cut.sample).interval_ns = t - (m.valid_ns - imu->interval_ns);
        cut.valid_ns = t;
      }
      if (cut.valid_ns <= t) (void)then->Process(cut);
    }
    const auto asked = filter->BeliefAt(t);
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->t_ns, t);
    // The cut sample is rounded on its way: means to round-off.
    EXPECT_LT((asked->X_WB.p - then->Belief()->X_WB.p).norm(), 1e-13);
    EXPECT_LT((asked->v_WB - then->Belief()->v_WB).norm(), 1e-12);
  }
  EXPECT_FALSE(filter->BeliefAt(400 * kMs)) << "older than the history";
  ExpectSame(*filter->BeliefAt(1000 * kMs), *filter->Belief());
}

TEST_P(History, LooksAheadWithLessTrust) {
  SimulatedDrive drive(setup_, 12, 0.0);
  auto filter = Make(GetParam(), setup_, drive.DrawPrior(TestPrior().covariance));
  for (int i = 0; i < 100; ++i) (void)filter->Process(drive.Advance());
  const Estimate now = *filter->Belief();
  double last = now.covariance.diagonal().segment<3>(kPosition).sum();
  for (int i = 1; i <= 4; ++i) {
    for (int k = 0; k < 10; ++k) (void)drive.Advance();
    const auto ahead = filter->BeliefAt(drive.t_ns());
    ASSERT_TRUE(ahead);
    // The motion of the last sample for 50 to 200 ms: accelerations change by 0.3 m/s² in that
    // time.
    EXPECT_LT((ahead->X_WB.p - drive.Body().p).norm(), 0.5 * 0.3 * 0.2 * 0.2);
    const double trace = ahead->covariance.diagonal().segment<3>(kPosition).sum();
    EXPECT_GT(trace, last);
    last = trace;
  }
  ExpectSame(*filter->Belief(), now);
  EXPECT_FALSE(filter->BeliefAt(now.t_ns + 61 * models::kNsPerSecond));
}

TEST_P(History, StartsAgainBeyondAGapTooLongToBridge) {
  auto filter = Make(GetParam(), setup_, prior_);
  for (TimeNs t = 5 * kMs; t <= 100 * kMs; t += 5 * kMs) (void)filter->Process(RestingImu(t));
  const TimeNs later = 100 * models::kNsPerSecond;
  int refused = 0;
  bool again = false;
  for (TimeNs t = later; t <= later + 1200 * kMs; t += 5 * kMs) {
    const Report report = filter->Process(RestingImu(t));
    if (report.refusal == Refusal::kGap) ++refused;
    if (!report.reanchored) continue;
    again = true;
    EXPECT_EQ(report.bridged_ns, t - 100 * kMs);
  }
  EXPECT_TRUE(again);
  EXPECT_EQ(refused, 199) << "a second of steady samples, the last of which starts it";
  const Estimate e = *filter->Belief();
  EXPECT_EQ(e.t_ns, later + 1200 * kMs);
  // 3 m/s for 100 s, and any heading.
  EXPECT_GT(std::sqrt(e.covariance(kPosition, kPosition)), 290.0);
  EXPECT_GT(std::sqrt(e.covariance(kTheta + 2, kTheta + 2)), 1.5);
  const Report wheels = filter->Process(WheelsAt(e.t_ns, 0, 0));
  ASSERT_EQ(wheels.corrections().size(), 1u);
  EXPECT_EQ(wheels.corrections()[0].decision, Decision::kAccepted);
}

TEST_P(History, StaticInitialisationTakesTheTimeOfTheSamplesNotOfThePrior) {
  setup_.initialisation = {InitialisationKind::kStatic, 0.1};
  auto filter = Make(GetParam(), setup_, TestPrior());
  const TimeNs epoch = 1'700'000'000 * models::kNsPerSecond;
  EXPECT_EQ(filter->Process(RestingImu(epoch)).refusal, Refusal::kGap) << "one may be a glitch";
  EXPECT_EQ(filter->Process(RestingImu(5 * kMs)).refusal, Refusal::kNotInitialised);
  for (TimeNs t = epoch + 5 * kMs; t <= epoch + 200 * kMs; t += 5 * kMs) {
    (void)filter->Process(RestingImu(t));
  }
  ASSERT_TRUE(filter->Belief());
  EXPECT_EQ(filter->Belief()->t_ns, epoch + 200 * kMs);
}

TEST_P(History, ASingleStampFromFarAheadChangesNothing) {
  auto filter = Make(GetParam(), setup_, prior_);
  for (TimeNs t = 5 * kMs; t <= 2000 * kMs; t += 5 * kMs) {
    const TimeNs stamp = t % (50 * kMs) == 0 ? t + 200 * models::kNsPerSecond : t;
    const Report report = filter->Process(RestingImu(stamp));
    EXPECT_FALSE(report.reanchored);
    EXPECT_EQ(report.refusal == Refusal::kGap, stamp != t);
  }
  EXPECT_EQ(filter->Belief()->t_ns, 1995 * kMs);
}

INSTANTIATE_TEST_SUITE_P(Filters, History, ::testing::Values("inekf", "mekf"));

}  // namespace
}  // namespace reckon::estimator
