#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reckon/sim/triad_noise.h"
#include "sim/statistics.h"

// Each error of a triad, alone, against its formula.
namespace reckon::sim {
namespace {

using testing_sim::AllanDeviation;
using testing_sim::Correlation;
using testing_sim::CorrelationBand;
using testing_sim::Mean;
using testing_sim::MeanBand;
using testing_sim::Slope;
using testing_sim::Variance;
using testing_sim::VarianceBand;

const Eigen::Vector3d kZero = Eigen::Vector3d::Zero();

TriadNoise Gyro(const TriadErrors& errors, double dt_s = 0.005, std::uint64_t seed = 1) {
  return TriadNoise("imu", "gyro", errors, dt_s, seed);
}

/// The three channels of `count` readings of zero.
std::vector<std::vector<double>> ReadZero(TriadNoise noise, std::size_t count) {
  std::vector<std::vector<double>> channels(3, std::vector<double>(count));
  for (std::size_t n = 0; n < count; ++n) {
    const Eigen::Vector3d y = noise.Read(kZero, kZero).value;
    for (std::size_t axis = 0; axis < 3; ++axis) channels[axis][n] = y[static_cast<int>(axis)];
  }
  return channels;
}

TEST(NoiseStatistics, WhiteNoiseHasItsDensityAtEveryRate) {
  constexpr double kDensity = 6.109e-5;
  constexpr std::size_t kCount = 200'000;
  for (const double dt : {0.001, 0.005, 0.01}) {
    const double sigma = kDensity / std::sqrt(dt);
    for (const auto& x : ReadZero(Gyro({.noise_density = kDensity}, dt), kCount)) {
      EXPECT_NEAR(Mean(x), 0.0, MeanBand(sigma, kCount));
      EXPECT_NEAR(Variance(x), sigma * sigma, VarianceBand(sigma, kCount));
      EXPECT_LT(std::abs(Correlation(x, x, 1)), CorrelationBand(kCount));
    }
  }
}

TEST(NoiseStatistics, WhiteNoiseIsStationary) {
  constexpr std::size_t kCount = 400'000, kPart = kCount / 4;
  const auto x = ReadZero(Gyro({.noise_density = 1.0}, 1.0), kCount)[0];
  for (std::size_t part = 0; part < 4; ++part) {
    const std::span<const double> quarter(x.data() + part * kPart, kPart);
    EXPECT_NEAR(Mean(quarter), 0.0, MeanBand(1.0, kPart)) << "quarter " << part;
    EXPECT_NEAR(Variance(quarter), 1.0, VarianceBand(1.0, kPart)) << "quarter " << part;
  }
}

/// Slope of the Allan deviation over clusters of 1 to 256 samples, doubly logarithmic.
double AllanSlope(const std::vector<double>& x) {
  std::vector<double> log_tau, log_sigma;
  for (std::size_t m = 1; m <= 256; m *= 2) {
    log_tau.push_back(std::log(static_cast<double>(m)));
    log_sigma.push_back(std::log(AllanDeviation(x, m)));
  }
  return Slope(log_tau, log_sigma);
}

TEST(NoiseStatistics, AllanDeviationOfWhiteNoiseFallsWithSlopeMinusOneHalf) {
  constexpr double kDensity = 2.0;
  constexpr std::size_t kCount = 400'000;
  for (const auto& x : ReadZero(Gyro({.noise_density = kDensity}, 0.005), kCount)) {
    EXPECT_NEAR(AllanSlope(x), -0.5, 0.025);
    // σ_A(τ) = σ_c/√τ; the clusters of 256 give it to 1/√(2 · 1560) = 1.8 %.
    EXPECT_NEAR(AllanDeviation(x, 256), kDensity / std::sqrt(256 * 0.005), 0.09 * kDensity);
  }
  // Control: a random walk rises instead.
  EXPECT_GT(AllanSlope(ReadZero(Gyro({.bias_walk = 1.0}), kCount)[0]), 0.3);
}

/// b after each of `steps` samples, for many seeds: [step][seed and axis].
std::vector<std::vector<double>> BiasEnsemble(const TriadErrors& errors, double dt_s,
                                              std::size_t steps, std::size_t seeds) {
  std::vector<std::vector<double>> b(steps + 1);
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    TriadNoise noise = Gyro(errors, dt_s, seed);
    for (std::size_t n = 0; n <= steps; ++n) {
      for (int axis = 0; axis < 3; ++axis) b[n].push_back(noise.bias()[axis]);
      noise.Read(kZero, kZero);
    }
  }
  return b;
}

TEST(NoiseStatistics, BiasWalkGrowsAsTheRootOfTimeInIndependentSteps) {
  constexpr double kWalk = 3e-5, kDt = 0.01;
  constexpr std::size_t kSteps = 20, kSeeds = 10'000;
  const auto b = BiasEnsemble({.bias_walk = kWalk}, kDt, kSteps, kSeeds);
  EXPECT_EQ(Variance(b[0]), 0.0);
  for (const std::size_t n : {1UL, 5UL, 20UL}) {
    const double sigma = kWalk * std::sqrt(static_cast<double>(n) * kDt);
    EXPECT_NEAR(Mean(b[n]), 0.0, MeanBand(sigma, b[n].size()));
    EXPECT_NEAR(Variance(b[n]), sigma * sigma, VarianceBand(sigma, b[n].size()));
  }
  std::vector<double> later(b[5].size());
  for (std::size_t i = 0; i < later.size(); ++i) later[i] = b[20][i] - b[5][i];
  EXPECT_LT(std::abs(Correlation(b[5], later)), CorrelationBand(later.size()));
}

// The step is as long as the time constant: what is only good for short steps (φ ≈ 1 − dt/τ) gives
// 0.
TEST(NoiseStatistics, GaussMarkovBiasIsStationaryAndDecaysWithItsTimeConstant) {
  constexpr double kSigma = 4e-4, kTau = 2.0;
  constexpr std::size_t kSeeds = 20'000;
  const auto b =
      BiasEnsemble({.bias_instability = kSigma, .bias_time_constant_s = kTau}, kTau, 2, kSeeds);
  for (const auto& x : b) {
    EXPECT_NEAR(Mean(x), 0.0, MeanBand(kSigma, x.size()));
    EXPECT_NEAR(Variance(x), kSigma * kSigma, VarianceBand(kSigma, x.size()));
  }
  EXPECT_NEAR(Correlation(b[0], b[1]), std::exp(-1.0), CorrelationBand(b[0].size()));
  EXPECT_NEAR(Correlation(b[0], b[2]), std::exp(-2.0), CorrelationBand(b[0].size()));
}

TEST(NoiseStatistics, GaussMarkovBiasAlongOneRunHasTheSameStatistics) {
  constexpr double kSigma = 0.3, kTau = 1.0, kDt = 0.01;
  constexpr std::size_t kCount = 400'000;  // 4000 τ
  const auto x =
      ReadZero(Gyro({.bias_instability = kSigma, .bias_time_constant_s = kTau}, kDt), kCount)[1];
  // The variance of N samples of an AR(1) process has the relative deviation √(2τ/(N dt)).
  const double deviation = std::sqrt(2.0 * kTau / (kCount * kDt));
  EXPECT_NEAR(Variance(x), kSigma * kSigma, 5.0 * deviation * kSigma * kSigma);
  EXPECT_NEAR(Correlation(x, x, 100), std::exp(-1.0), 5.0 * deviation);
  // Its Allan deviation peaks at 0.618 σ_B near 1.89 τ; 2100 clusters give it to 1.5 %.
  EXPECT_NEAR(AllanDeviation(x, 189), 0.618 * kSigma, 5 * 0.015 * 0.618 * kSigma);
}

TEST(NoiseStatistics, ConstantsOfARunHaveTheirSpread) {
  constexpr std::size_t kSeeds = 10'000;
  std::vector<double> turn_on, scale, misalignment, g_sensitivity;
  const TriadErrors errors{
      .turn_on_bias = 0.02, .scale = 0.01, .misalignment = 0.005, .g_sensitivity = 2e-4};
  for (std::size_t seed = 0; seed < kSeeds; ++seed) {
    TriadNoise noise = Gyro(errors, 0.005, seed);
    const Eigen::Vector3d b = noise.Read(kZero, kZero).value;
    const Eigen::Vector3d x = noise.Read(Eigen::Vector3d::UnitX(), kZero).value - b;
    const Eigen::Vector3d g = noise.Read(kZero, 10.0 * Eigen::Vector3d::UnitZ()).value - b;
    turn_on.push_back(b.y());
    scale.push_back(x.x() - 1.0);
    misalignment.push_back(x.z());
    g_sensitivity.push_back(g.y() / 10.0);
  }
  const auto expect_spread = [&](const std::vector<double>& x, double sigma) {
    EXPECT_NEAR(Mean(x), 0.0, MeanBand(sigma, kSeeds));
    EXPECT_NEAR(Variance(x), sigma * sigma, VarianceBand(sigma, kSeeds));
  };
  expect_spread(turn_on, 0.02);
  expect_spread(scale, 0.01);
  expect_spread(misalignment, 0.005);
  expect_spread(g_sensitivity, 2e-4);
  EXPECT_LT(std::abs(Correlation(turn_on, scale)), CorrelationBand(kSeeds));
  EXPECT_LT(std::abs(Correlation(scale, misalignment)), CorrelationBand(kSeeds));
}

TEST(NoiseStatistics, QuantisationRoundsAndAddsATwelfthOfTheStepSquared) {
  constexpr double kLsb = 0.25;
  TriadNoise noise = Gyro({.resolution = kLsb});
  std::vector<double> error;
  for (int n = 0; n < 100'000; ++n) {
    const double x = 1e-3 * std::sqrt(2.0) * n;  // irrational steps meet every place between codes
    const double y = noise.Read(Eigen::Vector3d(x, 0, 0), kZero).value.x();
    EXPECT_EQ(std::remainder(y, kLsb), 0.0);
    error.push_back(y - x);
    ASSERT_LE(std::abs(error.back()), 0.5 * kLsb * (1 + 1e-9));
  }
  EXPECT_NEAR(Mean(error), 0.0, 1e-3 * kLsb);
  EXPECT_NEAR(Variance(error), kLsb * kLsb / 12.0, 1e-3 * kLsb * kLsb / 12.0);
}

TEST(NoiseStatistics, SaturationClipsAfterTheOtherErrorsAndSetsTheFlag) {
  TriadNoise noise = Gyro({.range = 2.0, .resolution = 0.3});
  const auto inside = noise.Read(Eigen::Vector3d(1.9, -1.9, 0.0), kZero);
  EXPECT_FALSE(inside.saturated);
  EXPECT_NEAR(inside.value.x(), 1.8, 1e-12);
  const auto beyond = noise.Read(Eigen::Vector3d(0.0, -7.0, 0.0), kZero);
  EXPECT_TRUE(beyond.saturated);
  EXPECT_NEAR(beyond.value.y(), -2.1, 1e-12);  // −2 quantised
  // The clip comes after bias: a turn-on bias of many times the range saturates a body at rest.
  TriadNoise biased = Gyro({.turn_on_bias = 1e6, .range = 2.0});
  EXPECT_TRUE(biased.Read(kZero, kZero).saturated);
}

TEST(NoiseStatistics, ErrorsDoNotDisturbEachOthersStreams) {
  const TriadErrors alone{.noise_density = 1e-3};
  TriadErrors all = alone;
  all.bias_walk = 1e-4;
  all.bias_instability = 1e-3;
  all.turn_on_bias = 0.1;
  TriadNoise a = Gyro(alone), b = Gyro(all);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::Vector3d bias = b.bias();
    const Eigen::Vector3d difference =
        b.Read(kZero, kZero).value - bias - a.Read(kZero, kZero).value;
    ASSERT_LT(difference.norm(), 1e-15);
  }
}

}  // namespace
}  // namespace reckon::sim
