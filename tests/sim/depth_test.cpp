#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reckon/sim/depth_sensor.h"
#include "sim/analytic_motion.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::Measurement;
using testing_sim::Watch;

constexpr models::TimeNs kMs = 1'000'000;

double DepthOf(const Measurement& m) { return std::get<models::DepthSample>(m.sample).depth_m; }

TEST(Depth, IsHowFarItsOwnOriginLiesBelowZero) {
  const models::Pose X_BS = testing_sim::SlantedMounting();
  const testing_sim::RoughRide ride;
  DepthSensor sensor("depth", 3, X_BS,
                     {.timing = {.rate_hz = 20.0, .latency_s = 0.03, .stamp_error_s = 0.002}}, 1,
                     {});
  const auto out = Watch(sensor, ride, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), 20U);
  double lever = 0.0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto t_ns = static_cast<models::TimeNs>(n + 1) * 50 * kMs;
    EXPECT_EQ(out[n].sensor, 3);
    EXPECT_EQ(out[n].valid_ns, t_ns + 2 * kMs);
    EXPECT_EQ(out[n].arrival_ns, t_ns + 32 * kMs);
    // z of p + R r, row by row.
    const models::Pose X_WB = ride.At(models::Seconds(t_ns));
    const double arm =
        X_WB.R(2, 0) * X_BS.p.x() + X_WB.R(2, 1) * X_BS.p.y() + X_WB.R(2, 2) * X_BS.p.z();
    EXPECT_NEAR(DepthOf(out[n]), -X_WB.p.z() - arm, 1e-15);  // round-off of three products
    lever = std::max(lever, std::abs(arm - X_BS.p.z()));
  }
  EXPECT_GT(lever, 0.01);  // the ride turns the lever arm, so that a forgotten rotation shows
}

TEST(Depth, IsPositiveDownwards) {
  struct Below {
    models::Pose At(double) const { return {Eigen::Matrix3d::Identity(), {5, 6, -7}}; }
  };
  DepthSensor sensor("depth", 0, {}, {.timing = {.rate_hz = 10.0}}, 1, {});
  EXPECT_EQ(DepthOf(Watch(sensor, Below{}, kMs, 100 * kMs).at(0)), 7.0);
}

TEST(Depth, NoiseIsWhiteWithItsSigma) {
  constexpr double kSigma = 0.02;
  DepthSensor sensor("depth", 0, {}, {.timing = {.rate_hz = 100.0}, .noise_m = kSigma}, 1,
                     Environment{.step_ns = 10 * kMs});
  std::vector<double> x;
  for (const Measurement& m : Watch(sensor, testing_sim::Rest{}, 10 * kMs, 500'000 * kMs)) {
    x.push_back(DepthOf(m));
  }
  ASSERT_EQ(x.size(), 50'000U);
  EXPECT_NEAR(testing_sim::Mean(x), 0.0, testing_sim::MeanBand(kSigma, x.size()));
  EXPECT_NEAR(testing_sim::Variance(x), kSigma * kSigma,
              testing_sim::VarianceBand(kSigma, x.size()));
  EXPECT_LT(std::abs(testing_sim::Correlation(x, x, 1)), testing_sim::CorrelationBand(x.size()));
}

TEST(Depth, OffsetIsDrawnOnceARun) {
  constexpr double kSigma = 0.3;
  std::vector<double> offsets;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    DepthSensor sensor("depth", 0, {}, {.timing = {.rate_hz = 100.0}, .offset_m = kSigma}, seed,
                       Environment{.step_ns = 10 * kMs});
    const auto out = Watch(sensor, testing_sim::Rest{}, 10 * kMs, 30 * kMs);
    ASSERT_EQ(out.size(), 3U);
    EXPECT_EQ(DepthOf(out[0]), DepthOf(out[2]));
    offsets.push_back(DepthOf(out[0]));
  }
  EXPECT_NEAR(testing_sim::Mean(offsets), 0.0, testing_sim::MeanBand(kSigma, offsets.size()));
  EXPECT_NEAR(testing_sim::Variance(offsets), kSigma * kSigma,
              testing_sim::VarianceBand(kSigma, offsets.size()));
}

TEST(Depth, IsQuantisedToTheNearestStep) {
  const models::Pose X_BS{Eigen::Matrix3d::Identity(), {0, 0, -1.13}};
  DepthSensor sensor("depth", 0, X_BS, {.timing = {.rate_hz = 10.0}, .resolution_m = 0.25}, 1, {});
  EXPECT_EQ(DepthOf(Watch(sensor, testing_sim::Rest{}, kMs, 100 * kMs).at(0)), 1.25);
}

TEST(Depth, ReadsTheWeightOfTheWaterItTakesItToBe) {
  struct Deep {
    models::Pose At(double) const { return {Eigen::Matrix3d::Identity(), {0, 0, -20}}; }
  };
  // Calibrated in fresh water, it takes 20 m of the sea for 1025 / 997 of that.
  DepthSensor sensor("depth", 0, {}, {.timing = {.rate_hz = 10.0}, .assumed_density_kg_m3 = 997.0},
                     1, {});
  EXPECT_NEAR(DepthOf(Watch(sensor, Deep{}, kMs, 100 * kMs).at(0)), 20.0 * 1025 / 997, 1e-12);
}

TEST(Depth, ItsSurfaceWalksAtRandom) {
  constexpr double kDensity = 0.002;
  std::vector<double> after;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    DepthSensor sensor("depth", 0, {},
                       {.timing = {.rate_hz = 2.0}, .surface_drift_m_per_s_sqrt_hz = kDensity},
                       seed, Environment{.step_ns = 500 * kMs});
    after.push_back(DepthOf(Watch(sensor, testing_sim::Rest{}, 500 * kMs, 9000 * kMs).back()));
  }
  // Of 9 s: √9 times the density.
  EXPECT_NEAR(testing_sim::Variance(after) / std::pow(3 * kDensity, 2), 1.0,
              testing_sim::VarianceBand(1.0, after.size()));
}

TEST(Depth, RefusesNegativeErrors) {
  const auto refusal = [](const DepthConfig& config) -> std::string {
    try {
      DepthSensor("depth", 0, {}, config, 1, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({.noise_m = -0.1}),
            "sensor 'depth': noise_m is -0.1, expected a finite number of at least 0");
  EXPECT_NE(refusal({.offset_m = -0.1}).find("offset_m"), std::string::npos);
  EXPECT_NE(refusal({.resolution_m = std::nan("")}).find("resolution_m"), std::string::npos);
}

}  // namespace
}  // namespace reckon::sim
