#include "reckon/ground_truth/contact_scores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace reckon::ground_truth {
namespace {

constexpr models::TimeNs kStep = 10'000'000;

/// Two feet at 100 Hz: a letter an instant, `#` for a foot that stands.
std::vector<TrackSample> Samples(const std::string& true0, const std::string& belief0,
                                 const std::string& true1, const std::string& belief1) {
  std::vector<TrackSample> samples;
  const auto bits = [](char a, char b) {
    return static_cast<std::uint8_t>((a == '#' ? 1 : 0) | (b == '#' ? 2 : 0));
  };
  for (std::size_t k = 0; k < true0.size(); ++k) {
    TrackSample sample;
    sample.t_ns = static_cast<models::TimeNs>(k) * kStep;
    sample.feet = {bits(true0[k], true1[k]), bits(belief0[k], belief1[k]), true};
    samples.push_back(sample);
  }
  return samples;
}

TEST(ContactScores, CountEveryFootAtEveryInstant) {
  //                            right: 9 of 12        right: 11 of 12; both: 8
  const auto samples = Samples("....####....", "..######...#", "####....####", "####....###.");
  const ContactScores scores = ScoreContacts(samples, 2);
  EXPECT_DOUBLE_EQ(scores.foot_accuracy[0], 9.0 / 12.0);
  EXPECT_DOUBLE_EQ(scores.foot_accuracy[1], 11.0 / 12.0);
  EXPECT_DOUBLE_EQ(scores.accuracy, 20.0 / 24.0);
  EXPECT_DOUBLE_EQ(scores.all_accuracy, 9.0 / 12.0);  // the last instant is wrong for both
  EXPECT_DOUBLE_EQ(scores.false_positive_rate, 3.0 / 12.0);
  EXPECT_DOUBLE_EQ(scores.false_negative_rate, 1.0 / 12.0);
}

TEST(ContactScores, TellHowLateABeliefIs) {
  const auto samples = Samples("......######......######......", "........######......######....",
                               "......######......######......", "......######......######......");
  const ContactScores scores = ScoreContacts(samples, 2);
  // The first and last edges have no whole phase on both sides: a lift-off and a touchdown are left
  // of each foot, 20 ms late for one and in time for the other.
  EXPECT_EQ(scores.touchdowns, 2);
  EXPECT_EQ(scores.liftoffs, 2);
  EXPECT_NEAR(scores.touchdown_delay_s, 0.01, 1e-12);
  EXPECT_NEAR(scores.liftoff_delay_s, 0.01, 1e-12);
  EXPECT_EQ(scores.missed_touchdowns + scores.missed_liftoffs, 0);
}

TEST(ContactScores, CountWhatTheBeliefNeverSaw) {
  const auto samples = Samples("......######......######......", "......######..................",
                               "......######......######......", "......######......######......");
  const ContactScores scores = ScoreContacts(samples, 2);
  EXPECT_EQ(scores.missed_touchdowns, 1);
  EXPECT_EQ(scores.missed_liftoffs, 0);
  EXPECT_EQ(scores.touchdowns, 1);
}

TEST(ContactScores, DoNotTakeAReboundForAStep) {
  const auto samples = Samples("......#.######......######....", "......#.######......######....",
                               "......#.######......######....", "......########......######....");
  const ContactScores scores = ScoreContacts(samples, 2);
  EXPECT_EQ(scores.touchdowns + scores.missed_touchdowns, 2);
  EXPECT_EQ(scores.missed_touchdowns, 0);
}

TEST(ContactScores, AreNothingWithoutABelief) {
  auto samples = Samples("..##", "..##", "..##", "..##");
  for (TrackSample& sample : samples) sample.feet.said = false;
  EXPECT_TRUE(std::isnan(ScoreContacts(samples, 2).accuracy));
}

}  // namespace
}  // namespace reckon::ground_truth
