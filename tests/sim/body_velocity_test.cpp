#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reckon/sim/body_velocity_sensor.h"
#include "sim/analytic_motion.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::BodyVelocitySample;
using models::Measurement;
using models::Pose;
using testing_sim::Watch;

constexpr models::TimeNs kMs = 1'000'000;

const BodyVelocitySample& SampleOf(const Measurement& m) {
  return std::get<BodyVelocitySample>(m.sample);
}

/// Drives a circle at constant speed, heading along it.
struct Circle {
  static constexpr double kRadius = 2.0, kRate = 0.5;
  Pose At(double t) const {
    const double a = kRate * t;
    return {Eigen::AngleAxisd(a, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
            {kRadius * std::sin(a), -kRadius * std::cos(a), 0.0}};
  }
};

TEST(BodyVelocity, IsTheVelocityOfItsOwnOriginInItsOwnAxes) {
  const Pose X_BS = testing_sim::SlantedMounting();
  BodyVelocitySensor sensor("dvl", 2, X_BS, {.timing = {.rate_hz = 20.0, .latency_s = 0.03}}, 1,
                            kMs);
  const auto out = Watch(sensor, Circle{}, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), 20U);
  // v_B + ω × r in body axes: (ωR − ω r_y, ω r_x, 0). The central difference is short by (ωh)²/6.
  const Eigen::Vector3d v_B(0.5 * 2.0 - 0.5 * X_BS.p.y(), 0.5 * X_BS.p.x(), 0.0);
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_EQ(out[n].valid_ns, static_cast<models::TimeNs>(n + 1) * 50 * kMs);
    EXPECT_EQ(out[n].arrival_ns, out[n].valid_ns + 30 * kMs);
    EXPECT_LT((X_BS.R * SampleOf(out[n]).v_WS_S - v_B).norm(), 1e-7);
    EXPECT_EQ(SampleOf(out[n]).covariance.norm(), 0.0);
  }
}

TEST(BodyVelocity, NoiseMatchesTheCovarianceThatItDelivers) {
  const Eigen::Vector3d sigma(0.01, 0.02, 0.005);
  BodyVelocitySensor sensor("dvl", 2, {}, {.timing = {.rate_hz = 100.0}, .noise_m_per_s = sigma}, 1,
                            10 * kMs);
  std::vector<std::vector<double>> x(3);
  for (const Measurement& m : Watch(sensor, testing_sim::Rest{}, 10 * kMs, 500'000 * kMs)) {
    EXPECT_EQ(SampleOf(m).covariance, Eigen::Matrix3d(sigma.cwiseAbs2().asDiagonal()));
    for (int i = 0; i < 3; ++i) x[static_cast<std::size_t>(i)].push_back(SampleOf(m).v_WS_S[i]);
  }
  using namespace testing_sim;
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = sigma[static_cast<int>(i)];
    const std::size_t n = x[i].size();
    EXPECT_NEAR(Mean(x[i]), 0.0, MeanBand(s, n));
    EXPECT_NEAR(Variance(x[i]), s * s, VarianceBand(s, n));
    EXPECT_LT(std::abs(Correlation(x[i], x[i], 1)), CorrelationBand(n));
    EXPECT_LT(std::abs(Correlation(x[i], x[(i + 1) % 3])), CorrelationBand(n));
  }
}

TEST(BodyVelocity, RefusesNegativeNoise) {
  BodyVelocityConfig config;
  config.noise_m_per_s.y() = -0.1;
  EXPECT_THROW(BodyVelocitySensor("dvl", 0, {}, config, 1, kMs), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
