#include "reckon/ground_truth/nis.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <random>

namespace reckon::ground_truth {
namespace {

using estimator::Correction;
using estimator::Decision;

/// A correction of `sensor` with the covariance S of one of its `rows` rows and correlation.
Correction MakeCorrection(models::TimeNs t_ns, models::SensorId sensor, const Eigen::Vector3d& z,
                          const Eigen::Matrix3d& S, int rows) {
  Correction correction;
  correction.t_ns = t_ns;
  correction.sensor = sensor;
  correction.rows = rows;
  correction.innovation = z;
  correction.covariance = S;
  correction.nis = z.head(rows).dot(S.topLeftCorner(rows, rows).inverse() * z.head(rows));
  return correction;
}

/// A run of innovations z_k+1 = ρ z_k + … with unit covariance after whitening by S.
Track Innovations(int count, double rho, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::Matrix3d L;
  L << 0.1, 0, 0, 0.05, 0.2, 0, 0, 0.1, 0.3;
  const Eigen::Matrix3d S = L * L.transpose();
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Track track;
  for (int k = -100; k < count; ++k) {
    const Eigen::Vector3d w(normal(generator), normal(generator), normal(generator));
    u = rho * u + std::sqrt(1.0 - rho * rho) * w;
    if (k >= 0) track.Add(MakeCorrection(k * 1000, 1, L * u, S, 3));
  }
  return track;
}

TEST(Nis, OfWhiteInnovations) {
  constexpr int kCount = 4000;
  const NisStatistics nis = NisOf(Innovations(kCount, 0.0, 3).corrections(), 1);
  EXPECT_EQ(nis.corrections, 4000U);
  EXPECT_EQ(nis.dof, 3.0);
  EXPECT_NEAR(nis.mean, 3.0, 5.0 * std::sqrt(6.0 / kCount));  // five sigma of a mean of χ²_3
  EXPECT_NEAR(nis.lag1, 0.0, 5.0 / std::sqrt(3.0 * kCount));  // three white rows
}

TEST(Nis, OfCoupledInnovations) {
  constexpr int kCount = 40000;
  const double rho = 0.8;
  const NisStatistics nis = NisOf(Innovations(kCount, rho, 3).corrections(), 1);
  EXPECT_NEAR(nis.lag1, rho, 0.02);
}

TEST(Nis, OfOneSensorCountsRejectedOnesAndNoRefusedOnes) {
  Track track;
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity();
  track.Add(MakeCorrection(0, 1, {1.0, 0.0, 0.0}, S, 1));
  Correction rejected = MakeCorrection(1, 1, {3.0, 0.0, 0.0}, S, 1);
  rejected.decision = Decision::kRejected;
  track.Add(rejected);
  Correction refused = MakeCorrection(2, 1, {100.0, 0.0, 0.0}, S, 1);
  refused.decision = Decision::kRefused;
  refused.reason = estimator::Refusal::kNotFinite;
  track.Add(refused);
  track.Add(MakeCorrection(3, 2, {50.0, 0.0, 0.0}, S, 1));  // another sensor
  track.AddRefusal(1, 5, estimator::Refusal::kLate);
  track.AddRefusal(1, 6, estimator::Refusal::kUnused);  // no event

  const NisStatistics nis = NisOf(track.corrections(), 1);
  EXPECT_EQ(nis.corrections, 2U);
  EXPECT_DOUBLE_EQ(nis.mean, 5.0);  // (1 + 9) / 2
  EXPECT_EQ(nis.dof, 1.0);
  const DecisionCounts counts = CountDecisions(track, 1);
  EXPECT_EQ(counts.decisions, (std::array<std::size_t, 6>{1, 0, 0, 1, 1, 0}));
  EXPECT_EQ(counts.refusals[static_cast<std::size_t>(estimator::Refusal::kNotFinite)], 1U);
  EXPECT_EQ(counts.refusals[static_cast<std::size_t>(estimator::Refusal::kLate)], 1U);
  EXPECT_EQ(counts.refusals[static_cast<std::size_t>(estimator::Refusal::kUnused)], 0U);
  EXPECT_TRUE(std::isnan(NisOf(track.corrections(), 7).mean));
}

/// Two corrections a measurement: the first follows the first and the second the second. Compared
/// crosswise, these constant rows would look uncorrelated.
TEST(Nis, WhitenessComparesLikeWithLike) {
  Track track;
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 100; ++k) {
    track.Add(MakeCorrection(k, 0, {1.0, 0.0, 0.0}, S, 1));
    track.Add(MakeCorrection(k, 0, {-1.0, 0.0, 0.0}, S, 1));
  }
  EXPECT_NEAR(NisOf(track.corrections(), 0).lag1, 0.99, 1e-12);  // 99 products over 100 squares
}

}  // namespace
}  // namespace reckon::ground_truth
