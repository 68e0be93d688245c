#include "reckon/ground_truth/drift.h"

#include <gtest/gtest.h>

#include "ground_truth/tracks.h"

namespace reckon::ground_truth {
namespace {

using testing::LineTrack;

TEST(Drift, OfALine) {
  // 100 m in 100 s; a constant offset is no drift, 1 cm a metre sideways is.
  const Drift drift =
      DriftOf(LineTrack(101, [](int k) { return Eigen::Vector3d(5.0, 0.01 * k, 0.0); }).samples());
  EXPECT_NEAR(drift.final_m, 1.0, 1e-12);
  EXPECT_NEAR(drift.percent, 1.0, 1e-12);
  EXPECT_NEAR(drift.path_m, 100.0, 1e-12);
  EXPECT_NEAR(drift.duration_s, 100.0, 1e-12);
  EXPECT_NEAR(drift.m_per_min, 0.6, 1e-12);
  EXPECT_NEAR(drift.final_deg, 0.0, 1e-12);
}

TEST(Drift, OfAStandingRunNeedsNoPath) {
  Track track;
  for (int k = 0; k <= 120; ++k) {  // two minutes
    Truth truth;
    truth.t_ns = k * models::kNsPerSecond;
    estimator::Estimate estimate = testing::Exact(truth);
    estimate.X_WB = {testing::Rz(k * std::numbers::pi / 180.0 / 60.0), {0.0, 0.0, 0.001 * k}};
    track.Add(truth, estimate);
  }
  const Drift drift = DriftOf(track.samples());
  EXPECT_TRUE(std::isnan(drift.percent));
  EXPECT_NEAR(drift.m_per_min, 0.06, 1e-12);
  EXPECT_NEAR(drift.deg_per_min, 1.0, 1e-10);
}

}  // namespace
}  // namespace reckon::ground_truth
