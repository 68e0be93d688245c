#include "reckon/ground_truth/rpe.h"

#include <gtest/gtest.h>

#include "ground_truth/tracks.h"

namespace reckon::ground_truth {
namespace {

using testing::LineTrack;
using testing::Rz;

Eigen::Vector3d NoError(int) { return Eigen::Vector3d::Zero(); }

TEST(Pairs, ByFrames) {
  EXPECT_EQ(PairsByFrames(7, 3, PairChoice::kConsecutive), (IndexPairs{{0, 3}, {3, 6}}));
  EXPECT_EQ(PairsByFrames(6, 3, PairChoice::kConsecutive), (IndexPairs{{0, 3}}));
  EXPECT_EQ(PairsByFrames(6, 3, PairChoice::kAll), (IndexPairs{{0, 3}, {1, 4}, {2, 5}}));
  EXPECT_TRUE(PairsByFrames(3, 3, PairChoice::kAll).empty());
}

TEST(Pairs, ByPath) {
  const Track track = LineTrack(6, NoError);  // at 0, 1, … 5 m
  EXPECT_EQ(PairsByPath(track.samples(), 2.0, PairChoice::kConsecutive),
            (IndexPairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(PairsByPath(track.samples(), 1.5, PairChoice::kConsecutive),
            (IndexPairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(PairsByPath(track.samples(), 4.0, PairChoice::kAll), (IndexPairs{{0, 4}, {1, 5}}));
  // Nothing is within 10 % of 1.5 m, and 4.5 m lies between two samples.
  EXPECT_TRUE(PairsByPath(track.samples(), 1.5, PairChoice::kAll).empty());
  EXPECT_TRUE(PairsByPath(track.samples(), 100.0, PairChoice::kAll).empty());
}

TEST(Pairs, ByPathTakeTheTruthsPathAndTheFirstOfEquallyNearEnds) {
  Track track;
  const std::vector<double> true_x{0.0, 1.0, 1.0, 1.0, 2.0};  // stands still in between
  for (std::size_t k = 0; k < true_x.size(); ++k) {
    Truth truth;
    truth.X_WB.p.x() = true_x[k];
    estimator::Estimate estimate = testing::Exact(truth);
    estimate.X_WB.p *= 3.0;  // its own path is three times as long
    track.Add(truth, estimate);
  }
  EXPECT_EQ(PairsByPath(track.samples(), 1.0, PairChoice::kAll),
            (IndexPairs{{0, 1}, {1, 4}, {2, 4}, {3, 4}}));
}

TEST(Pairs, ByTime) {
  const Track track = LineTrack(6, NoError);  // one a second
  EXPECT_EQ(PairsByTime(track.samples(), 2.0, PairChoice::kConsecutive),
            (IndexPairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(PairsByTime(track.samples(), 4.0, PairChoice::kAll), (IndexPairs{{0, 4}, {1, 5}}));
}

TEST(RelativeError, OfAScaleErrorIsThatOfTheSegment) {
  const Track track = LineTrack(21, [](int k) { return Eigen::Vector3d(0.02 * k, 0.0, 0.0); });
  const auto pairs = PairsByPath(track.samples(), 10.0, PairChoice::kAll);
  const auto errors = RelativeError(track.samples(), pairs).translation_m;
  ASSERT_EQ(pairs.size(), 12U);  // 0 to 10, …, 10 to 20, and 11 to 20, which is within 10 %
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto metres = static_cast<double>(pairs[k].second - pairs[k].first);
    EXPECT_NEAR(errors[k], 0.02 * metres, 1e-13);
  }
}

/// E = (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j) of a robot that drives 1 m and turns by 90°, estimated as 60°:
/// the rotation differs by 30° and the translation not at all. A motion common to all estimates
/// changes nothing.
TEST(RelativeError, OfATurn) {
  Track track;
  const models::Pose gauge{testing::Rot(1.0, {1.0, 2.0, 3.0}), {7.0, 8.0, 9.0}};
  for (int k = 0; k < 2; ++k) {
    Truth truth;
    truth.X_WB = {Rz(k * std::numbers::pi / 2.0), {double(k), 0.0, 0.0}};
    estimator::Estimate estimate = testing::Exact(truth);
    estimate.X_WB = gauge * models::Pose{Rz(k * std::numbers::pi / 3.0), truth.X_WB.p};
    track.Add(truth, estimate);
  }
  const RelativeErrors errors = RelativeError(track.samples(), {{0, 1}});
  EXPECT_NEAR(errors.rotation_deg[0], 30.0, 1e-12);
  EXPECT_NEAR(errors.translation_m[0], 0.0, 1e-14);
}

TEST(PathLength, OfALine) {
  EXPECT_DOUBLE_EQ(PathLength(LineTrack(11, NoError).samples()), 10.0);
  EXPECT_EQ(PathLength({}), 0.0);
}

}  // namespace
}  // namespace reckon::ground_truth
