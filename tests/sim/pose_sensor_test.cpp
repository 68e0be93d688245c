#include <stdexcept>

#include <gtest/gtest.h>

#include "reckon/sim/pose_sensor.h"
#include "reckon/sim/rotation_vector.h"
#include "sim/analytic_motion.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::Measurement;
using models::Pose;
using models::PoseSample;
using testing_sim::Watch;

constexpr models::TimeNs kMs = 1'000'000;

const PoseSample& SampleOf(const Measurement& m) { return std::get<PoseSample>(m.sample); }

TEST(PoseSensor, IsThePoseOfItsOwnFrame) {
  const Pose X_BS = testing_sim::SlantedMounting();
  const testing_sim::RoughRide ride;
  PoseSensor sensor("gps", 4, X_BS,
                    {.timing = {.rate_hz = 20.0, .latency_s = 0.03, .stamp_error_s = -0.002}}, 1,
                    kMs);
  const auto out = Watch(sensor, ride, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), 20U);
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto t_ns = static_cast<models::TimeNs>(n + 1) * 50 * kMs;
    EXPECT_EQ(out[n].sensor, 4);
    EXPECT_EQ(out[n].valid_ns, t_ns - 2 * kMs);
    EXPECT_EQ(out[n].arrival_ns, t_ns + 30 * kMs);
    const Pose X_WB = ride.At(models::Seconds(t_ns));
    const PoseSample& sample = SampleOf(out[n]);
    EXPECT_TRUE(sample.has_orientation);
    // Round-off of one product of matrices whose entries are below 5.
    EXPECT_LT((sample.X_WS.p - X_WB.p - X_WB.R * X_BS.p).norm(), 1e-14);
    EXPECT_LT((X_WB.R.transpose() * sample.X_WS.R - X_BS.R).norm(), 1e-14);
  }
}

TEST(PoseSensor, NoiseMatchesTheSigmasThatItDelivers) {
  // Small turns: Log takes them to the drawn vector exactly, however large the other axes' are.
  PoseConfig config{.timing = {.rate_hz = 100.0}};
  config.noise_position_m = {0.01, 0.02, 0.5};
  config.noise_orientation_rad = {0.03, 0.01, 0.002};
  const Pose X_BS = testing_sim::SlantedMounting();  // control: noise in axes of S would be mixed
  PoseSensor sensor("gps", 0, X_BS, config, 1, 10 * kMs);
  std::vector<std::vector<double>> x(6);
  for (const Measurement& m : Watch(sensor, testing_sim::Rest{}, 10 * kMs, 500'000 * kMs)) {
    const PoseSample& sample = SampleOf(m);
    EXPECT_EQ(sample.position_sigma_m, config.noise_position_m);
    EXPECT_EQ(sample.orientation_sigma_rad, config.noise_orientation_rad);
    const Eigen::Vector3d turn = RotationLog(sample.X_WS.R * X_BS.R.transpose());
    for (int i = 0; i < 3; ++i) {
      x[static_cast<std::size_t>(i)].push_back(sample.X_WS.p[i] - X_BS.p[i]);
      x[3 + static_cast<std::size_t>(i)].push_back(turn[i]);
    }
  }
  using namespace testing_sim;
  for (std::size_t i = 0; i < 6; ++i) {
    const int axis = static_cast<int>(i % 3);
    const double s = i < 3 ? config.noise_position_m[axis] : config.noise_orientation_rad[axis];
    const std::size_t n = x[i].size();
    ASSERT_EQ(n, 50'000U);
    EXPECT_NEAR(Mean(x[i]), 0.0, MeanBand(s, n)) << i;
    EXPECT_NEAR(Variance(x[i]), s * s, VarianceBand(s, n)) << i;
    EXPECT_LT(std::abs(Correlation(x[i], x[i], 1)), CorrelationBand(n)) << i;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_LT(std::abs(Correlation(x[i], x[j])), CorrelationBand(n)) << i << ", " << j;
    }
  }
}

TEST(PoseSensor, DeliversNoSigmaOfZero) {
  PoseConfig config{.timing = {.rate_hz = 10.0}};
  config.noise_position_m = {0.0, 0.1, 1e-9};
  PoseSensor sensor("gps", 0, {}, config, 1, kMs);
  const auto out = Watch(sensor, testing_sim::Rest{}, kMs, 100 * kMs);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(SampleOf(out[0]).position_sigma_m, Eigen::Vector3d(1e-6, 0.1, 1e-6));
  EXPECT_EQ(SampleOf(out[0]).orientation_sigma_rad, Eigen::Vector3d::Constant(1e-6));
  EXPECT_EQ(SampleOf(out[0]).X_WS.p.x(), 0.0);  // no noise was drawn for the least sigma
}

TEST(PoseSensor, WithoutOrientationSaysNothingOfIt) {
  PoseConfig config{.timing = {.rate_hz = 10.0}, .orientation = false};
  config.noise_position_m.setConstant(0.1);
  config.noise_orientation_rad.setConstant(0.1);
  PoseSensor sensor("gps", 0, testing_sim::SlantedMounting(), config, 1, kMs);
  config.orientation = true;
  PoseSensor whole("gps", 0, testing_sim::SlantedMounting(), config, 1, kMs);
  const auto out = Watch(sensor, testing_sim::Rest{}, kMs, 1000 * kMs);
  const auto with = Watch(whole, testing_sim::Rest{}, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), 10U);
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_FALSE(SampleOf(out[n]).has_orientation);
    EXPECT_EQ(SampleOf(out[n]).X_WS.R, Eigen::Matrix3d::Identity());
    EXPECT_EQ(SampleOf(out[n]).X_WS.p, SampleOf(with[n]).X_WS.p);  // the same draws
    EXPECT_NE(SampleOf(with[n]).X_WS.R, Eigen::Matrix3d::Identity());
  }
}

TEST(PoseSensor, RefusesNegativeNoise) {
  PoseConfig config;
  config.noise_position_m.y() = -0.1;
  EXPECT_THROW(PoseSensor("gps", 0, {}, config, 1, kMs), std::invalid_argument);
  config = {};
  config.noise_orientation_rad.z() = -0.1;
  EXPECT_THROW(PoseSensor("gps", 0, {}, config, 1, kMs), std::invalid_argument);
  EXPECT_NO_THROW(PoseSensor("gps", 0, {}, {}, 1, kMs));
}

}  // namespace
}  // namespace reckon::sim
