#include "reckon/sim/current.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

CurrentConfig Config() { return {{0.1, 0.05, 0.0}, 0.05, 300.0}; }

TEST(Current, IsItsMeanWithoutANoise) {
  CurrentConfig config = Config();
  config.sigma_m_s = 0.0;
  Current current(config, 1);
  for (const double t : {0.0, 0.3, 17.5, 1e4}) {
    EXPECT_EQ(current.At(t).velocity_m_s, config.mean_m_s);
    EXPECT_EQ(current.At(t).acceleration_m_s2, Vector3d::Zero());
  }
}

TEST(Current, IsAGaussMarkovProcess) {
  // 200 runs of 600 s: of the start, of the end, and of what the end owes to the start.
  constexpr int kRuns = 200;
  double start = 0.0, end = 0.0, product = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Current current(Config(), seed);
    const Vector3d a = current.At(0.0).velocity_m_s - Config().mean_m_s;
    const Vector3d b = current.At(300.0).velocity_m_s - Config().mean_m_s;
    start += a.squaredNorm();
    end += b.squaredNorm();
    product += a.dot(b);
  }
  const double count = 3 * kRuns, variance = 0.05 * 0.05;
  // Mean squares of 600 draws scatter by sqrt(2/600), products by sqrt((1 + e^-2)/600): 5 sigma.
  EXPECT_NEAR(start / count / variance, 1.0, 5 * std::sqrt(2 / count));
  EXPECT_NEAR(end / count / variance, 1.0, 5 * std::sqrt(2 / count));
  EXPECT_NEAR(product / count / variance, std::exp(-1.0), 5 * std::sqrt(1.14 / count));
}

TEST(Current, AccelerationIsTheDerivativeAndContinuous) {
  Current current(Config(), 3);
  constexpr double h = 1e-3;
  std::vector<WaterMotion> all;
  for (int i = 0; i <= 5000; ++i) all.push_back(current.At(i * h));
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const Vector3d difference = (all[i + 1].velocity_m_s - all[i - 1].velocity_m_s) / (2 * h);
    // The spline's third derivative is some 0.1 m/s^4, and jumps at knots in its second.
    EXPECT_LT((difference - all[i].acceleration_m_s2).norm(), 5e-5) << i;
    EXPECT_LT((all[i + 1].acceleration_m_s2 - all[i].acceleration_m_s2).norm(), 1e-4) << i;
    largest = std::max(largest, all[i].acceleration_m_s2.norm());
  }
  EXPECT_GT(largest, 1e-3) << "it does change";
}

TEST(Current, DependsOnTheSeedAlone) {
  Current a(Config(), 5), b(Config(), 5), other(Config(), 6);
  for (double t = 0.0; t < 20.0; t += 0.01) a.At(t);  // one asks often, the other once
  EXPECT_EQ(a.At(20.0).velocity_m_s, b.At(20.0).velocity_m_s);
  EXPECT_NE(a.At(20.5).velocity_m_s, other.At(20.5).velocity_m_s);
}

TEST(Current, RefusesWhatDoesNotFlow) {
  CurrentConfig config = Config();
  config.time_constant_s = 0.0;
  EXPECT_THROW(Current(config, 1), std::invalid_argument);
  config = Config();
  config.sigma_m_s = -0.1;
  EXPECT_THROW(Current(config, 1), std::invalid_argument);
  config = Config();
  config.mean_m_s.y() = std::nan("");
  EXPECT_THROW(Current(config, 1), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
