#include "reckon/sim/random_stream.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using testing_sim::Correlation;
using testing_sim::CorrelationBand;
using testing_sim::Mean;
using testing_sim::MeanBand;
using testing_sim::Variance;
using testing_sim::VarianceBand;

constexpr std::size_t kCount = 200'000;

std::vector<double> Normals(const RandomStream& stream, std::uint32_t channel) {
  std::vector<double> x(kCount);
  for (std::size_t n = 0; n < kCount; ++n) x[n] = stream.Normal(channel, n);
  return x;
}

std::vector<double> Uniforms(const RandomStream& stream, std::uint32_t channel) {
  std::vector<double> x(kCount);
  for (std::size_t n = 0; n < kCount; ++n) x[n] = stream.Uniform(channel, n);
  return x;
}

TEST(RandomStream, IsPhiloxKeyedBySeedAndName) {
  struct Case {
    std::uint64_t seed;
    std::string name;
    std::uint32_t channel;
    std::uint64_t index;
    double normal, uniform;
  };
  // From a separate implementation of FNV-1a, SplitMix64, Philox 4x32-10 (checked against the known
  // answers of its paper) and Box-Muller, in Python.
  const std::array<Case, 5> cases{{
      {1, "imu.gyro.noise", 0, 0, -0.3071237684791409, 0.07228878268929295},
      {1, "imu.gyro.noise", 2, 12345, 0.4725014742337408, 0.12072797009326042},
      {2, "imu.gyro.noise", 2, 12345, 0.7790521445969831, 0.3341045660968899},
      {0, "", 0, 0, 1.4889263608269832, 0.7089026494324264},
      {~std::uint64_t{0}, "wheels.noise", 4, 1099511627783, 0.5714133049903396, 0.6080194366419129},
  }};
  for (const Case& c : cases) {
    const RandomStream stream(c.seed, c.name);
    EXPECT_NEAR(stream.Normal(c.channel, c.index), c.normal, 1e-14);  // libm's sin and log differ
    EXPECT_EQ(stream.Uniform(c.channel, c.index), c.uniform);
  }
}

TEST(RandomStream, NormalDrawsAreStandardNormal) {
  const std::vector<double> x = Normals(RandomStream(7, "a"), 0);
  EXPECT_NEAR(Mean(x), 0.0, MeanBand(1.0, kCount));
  EXPECT_NEAR(Variance(x), 1.0, VarianceBand(1.0, kCount));
  for (const double limit : {0.5, 1.0, 2.0, 3.0, 4.0}) {
    double beyond = 0.0;
    for (const double value : x) beyond += value > limit ? 1.0 : 0.0;
    const double p = 0.5 * std::erfc(limit / std::sqrt(2.0));
    const double sd = std::sqrt(p * (1.0 - p) * kCount);
    EXPECT_NEAR(beyond, p * kCount, 5.0 * sd) << "beyond " << limit << " sigma";
  }
}

TEST(RandomStream, UniformDrawsFillTheUnitIntervalEvenly) {
  std::array<double, 64> bins{};
  for (const double value : Uniforms(RandomStream(7, "a"), 0)) {
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    bins.at(static_cast<std::size_t>(value * 64.0)) += 1.0;
  }
  const double expected = kCount / 64.0;
  double chi2 = 0.0;
  for (const double bin : bins) chi2 += (bin - expected) * (bin - expected) / expected;
  EXPECT_NEAR(chi2, 63.0, 5.0 * std::sqrt(2.0 * 63.0));
}

TEST(RandomStream, StreamsChannelsSeedsAndKindsAreIndependent) {
  const std::vector<double> reference = Normals(RandomStream(1, "imu.gyro.noise"), 0);
  const std::vector<std::vector<double>> others{
      Normals(RandomStream(1, "imu.gyro.noise"), 1),
      Normals(RandomStream(1, "imu.accel.noise"), 0),
      Normals(RandomStream(2, "imu.gyro.noise"), 0),
      Normals(RandomStream(0, "imu.gyro.noise"), 0),
      Uniforms(RandomStream(1, "imu.gyro.noise"), 0),
  };
  for (const std::vector<double>& other : others) {
    EXPECT_LT(std::abs(Correlation(reference, other)), CorrelationBand(kCount));
    EXPECT_LT(std::abs(Correlation(reference, other, 1)), CorrelationBand(kCount));
  }
  EXPECT_LT(std::abs(Correlation(reference, reference, 1)), CorrelationBand(kCount));
  // Control: the same address is the same draw.
  EXPECT_NEAR(Correlation(reference, Normals(RandomStream(1, "imu.gyro.noise"), 0)), 1.0, 1e-4);
}

TEST(RandomStream, NeighbouringSeedsGiveIndependentFirstDraws) {
  std::vector<double> x(kCount);
  for (std::size_t seed = 0; seed < kCount; ++seed) {
    x[seed] = RandomStream(seed, "imu.gyro.turn_on_bias").Normal(0, 0);
  }
  EXPECT_NEAR(Mean(x), 0.0, MeanBand(1.0, kCount));
  EXPECT_NEAR(Variance(x), 1.0, VarianceBand(1.0, kCount));
  EXPECT_LT(std::abs(Correlation(x, x, 1)), CorrelationBand(kCount));
}

}  // namespace
}  // namespace reckon::sim
