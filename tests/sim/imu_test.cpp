#include "reckon/sim/imu.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "sim/analytic_motion.h"

namespace reckon::sim {
namespace {

using models::ImuSample;
using models::Measurement;
using models::Pose;
using testing_sim::Rest;
using testing_sim::SlantedMounting;
using testing_sim::Watch;

constexpr models::TimeNs kMs = 1'000'000;
constexpr double kGravity = 9.81;

Imu MakeImu(const ImuConfig& config, const Pose& X_BS = {}, models::TimeNs step_ns = kMs) {
  return Imu("imu", 3, X_BS, config, 1, step_ns, kGravity);
}

const ImuSample& SampleOf(const Measurement& m) { return std::get<ImuSample>(m.sample); }

/// A turntable: constant rate about the vertical through the origin.
struct Turntable {
  double rate_rad_s;
  Pose At(double t) const {
    return {Eigen::AngleAxisd(rate_rad_s * t, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
            Eigen::Vector3d::Zero()};
  }
};

/// Swings about the vertical with the rate amplitude · cos(2π f t).
struct Swing {
  double amplitude_rad_s, frequency_hz;
  Pose At(double t) const {
    const double w = 2.0 * std::numbers::pi * frequency_hz;
    return {Eigen::AngleAxisd(amplitude_rad_s / w * std::sin(w * t), Eigen::Vector3d::UnitZ())
                .toRotationMatrix(),
            Eigen::Vector3d::Zero()};
  }
};

TEST(Imu, StampsTheEndsOfItsIntervalsAndArrivesLatencyLater) {
  Imu imu = MakeImu({.timing = {.rate_hz = 200.0, .latency_s = 0.0123}});
  const auto out = Watch(imu, Rest{}, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), 200U);
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_EQ(out[n].sensor, 3);
    EXPECT_EQ(out[n].valid_ns, static_cast<models::TimeNs>(n + 1) * 5 * kMs);
    EXPECT_EQ(out[n].arrival_ns - out[n].valid_ns, 12'300'000);
    EXPECT_EQ(SampleOf(out[n]).interval_ns, 5 * kMs);
  }
}

TEST(Imu, AClockThatIsOffMovesTheClaimAndNotTheMotion) {
  for (const double error_s : {0.02, -0.02}) {
    Imu imu = MakeImu({.timing = {.latency_s = 0.001, .stamp_error_s = error_s}});
    const Measurement m = Watch(imu, Rest{}, kMs, 5 * kMs)[0];
    EXPECT_EQ(m.valid_ns, 5 * kMs + (error_s > 0 ? 20 : -20) * kMs);
    EXPECT_EQ(m.arrival_ns,
              std::max(m.valid_ns, 5 * kMs) + kMs);  // never before it is claimed valid
  }
}

TEST(Imu, FeelsGravityUpwardsAtRestInItsOwnAxes) {
  for (const ImuMode mode : {ImuMode::kIncrement, ImuMode::kPoint}) {
    Imu imu = MakeImu({.mode = mode}, SlantedMounting());
    const auto out = Watch(imu, Rest{}, kMs, 20 * kMs);
    const Eigen::Vector3d up = SlantedMounting().R.transpose() * Eigen::Vector3d(0, 0, kGravity);
    EXPECT_LT(SampleOf(out.back()).gyro_rad_s.norm(), 1e-12);
    EXPECT_LT((SampleOf(out.back()).accel_m_s2 - up).norm(), 1e-9);
  }
}

// ω and the centripetal acceleration −ω² r of a turntable are constant in the sensor's axes.
TEST(Imu, FeelsTheTurntable) {
  const double w = 3.0;
  for (const ImuMode mode : {ImuMode::kIncrement, ImuMode::kPoint}) {
    Imu imu = MakeImu({.mode = mode}, SlantedMounting());
    const Pose X_BS = SlantedMounting();
    for (const Measurement& m : Watch(imu, Turntable{w}, kMs, 1000 * kMs)) {
      const Eigen::Vector3d r(X_BS.p.x(), X_BS.p.y(), 0.0);
      const Eigen::Vector3d f = Eigen::Vector3d(0, 0, kGravity) - w * w * r;
      EXPECT_LT((X_BS.R * SampleOf(m).gyro_rad_s - Eigen::Vector3d(0, 0, w)).norm(), 1e-9);
      // Central differences of a circle are short by a factor 1 − (wh)²/6 (increment: 1.5e-6 of
      // 1.8 m/s²); differences twice over lose digits: 1e-16/h².
      EXPECT_LT((X_BS.R * SampleOf(m).accel_m_s2 - f).norm(), 5e-6);
    }
  }
}

TEST(Imu, SaturatesInItsOwnAxesAndSaysSo) {
  ImuConfig config;
  config.gyro.range = 1.0;
  config.accel.range = 9.0;
  Imu imu = MakeImu(config);
  const auto out = Watch(imu, Turntable{3.0}, kMs, 5 * kMs);
  EXPECT_TRUE(SampleOf(out[0]).gyro_saturated);
  EXPECT_TRUE(SampleOf(out[0]).accel_saturated);
  EXPECT_EQ(SampleOf(out[0]).gyro_rad_s.z(), 1.0);
  EXPECT_EQ(SampleOf(out[0]).accel_m_s2.z(), 9.0);
  Imu wide = MakeImu({});
  EXPECT_FALSE(SampleOf(Watch(wide, Turntable{3.0}, kMs, 5 * kMs)[0]).gyro_saturated);
}

TEST(Imu, CarriesTheBiasThatItReports) {
  ImuConfig config;
  config.gyro.turn_on_bias = 0.1;
  config.accel.bias_walk = 0.1;
  Imu imu = MakeImu(config);
  std::vector<Measurement> out;
  for (models::TimeNs t = 0; t <= 100 * kMs; t += kMs) {
    const Eigen::Vector3d gyro = imu.gyro_bias(), accel = imu.accel_bias();
    out.clear();
    imu.Observe(testing_sim::WindowAt(Rest{}, t, kMs), out);
    if (out.empty()) continue;
    EXPECT_LT((SampleOf(out[0]).gyro_rad_s - gyro).norm(), 1e-14);
    EXPECT_LT((SampleOf(out[0]).accel_m_s2 - accel - Eigen::Vector3d(0, 0, kGravity)).norm(),
              1e-12);
  }
  EXPECT_GT(imu.gyro_bias().norm(), 1e-3);
}

/// Amplitude of the gyroscope's answer to a swing of amplitude 1 rad/s, once settled.
double Response(double frequency_hz, double bandwidth_hz, int poles, ImuMode mode) {
  constexpr models::TimeNs kStep = 100'000;  // 10 kHz: the physics is much faster than the filter
  ImuConfig config;
  config.timing.rate_hz = 10'000.0;
  config.mode = mode;
  config.bandwidth_hz = bandwidth_hz;
  config.bandwidth_poles = poles;
  Imu imu = MakeImu(config, {}, kStep);
  double sin = 0.0, cos = 0.0;
  for (const Measurement& m : Watch(imu, Swing{1.0, frequency_hz}, kStep, 2'000'000'000)) {
    if (m.valid_ns <= 1'000'000'000) continue;  // whole periods are left
    const double phase = 2.0 * std::numbers::pi * frequency_hz * models::Seconds(m.valid_ns);
    sin += SampleOf(m).gyro_rad_s.z() * std::sin(phase) * 2e-4;
    cos += SampleOf(m).gyro_rad_s.z() * std::cos(phase) * 2e-4;
  }
  return std::hypot(sin, cos);
}

TEST(Imu, BandwidthAttenuatesAsItsPolesSay) {
  for (const ImuMode mode : {ImuMode::kIncrement, ImuMode::kPoint}) {
    for (const double f : {10.0, 50.0, 150.0}) {
      const double x = f / 50.0;
      // A mean over one step, or over the two of a central difference, takes (πf 2h)²/6 = 1.5e-3.
      EXPECT_NEAR(Response(f, 50.0, 1, mode), 1.0 / std::sqrt(1.0 + x * x), 1.6e-3);
      EXPECT_NEAR(Response(f, 50.0, 2, mode), 1.0 / std::sqrt(1.0 + x * x * x * x), 1.6e-3);
      EXPECT_NEAR(Response(f, 0.0, 2, mode), 1.0, 1.6e-3);  // control: without bandwidth
    }
  }
}

TEST(Imu, RangeClipsTheShockAndNotItsMean) {
  // A swing of 1 rad/s at 50 Hz, sampled every quarter: its means are at most 2/π, within the
  // range.
  ImuConfig config;
  config.timing.rate_hz = 200.0;
  config.gyro.range = 0.7;
  const auto last = [&config] {
    Imu imu = MakeImu(config);
    return SampleOf(Watch(imu, Swing{1.0, 50.0}, kMs, 500 * kMs).back());
  };
  const auto mean = last();
  EXPECT_FALSE(mean.gyro_saturated);  // without a bandwidth nothing is known of what is inside
  config.bandwidth_hz = 400.0;
  const auto clipped = last();
  EXPECT_TRUE(clipped.gyro_saturated);
  EXPECT_FALSE(clipped.accel_saturated);
  config.gyro.range = 0.0;
  const auto whole = last();
  EXPECT_FALSE(whole.gyro_saturated);
  // Of a quarter from the peak, clipped at 0.7, the mean is (0.7 φ + 1 − sin φ) 2/π, φ = acos 0.7:
  // 0.536 / 0.637 of the whole. The filter passes both but for a few per cent.
  EXPECT_NEAR(std::abs(clipped.gyro_rad_s.z()) / std::abs(whole.gyro_rad_s.z()), 0.536 / 0.637,
              0.05);
}

TEST(Imu, BandwidthLeavesAConstantMotionAlone) {
  ImuConfig config;
  config.bandwidth_hz = 40.0;
  Imu imu = MakeImu(config, SlantedMounting());
  Imu reference = MakeImu({}, SlantedMounting());
  const auto out = Watch(imu, Turntable{2.0}, kMs, 1000 * kMs);
  const auto expected = Watch(reference, Turntable{2.0}, kMs, 1000 * kMs);
  ASSERT_EQ(out.size(), expected.size());
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_LT((SampleOf(out[n]).gyro_rad_s - SampleOf(expected[n]).gyro_rad_s).norm(), 1e-11);
    // Rounding of poses over the step h reads as 1e-16/h² in an acceleration.
    EXPECT_LT((SampleOf(out[n]).accel_m_s2 - SampleOf(expected[n]).accel_m_s2).norm(), 1e-8);
  }
}

/// The refusal's sentence, empty if there is none.
std::string Refusal(const ImuConfig& config) {
  try {
    MakeImu(config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Imu, RefusesWhatItCannotDoAndSaysWhy) {
  ImuConfig config;
  config.timing.rate_hz = 300.0;
  EXPECT_EQ(
      Refusal(config),
      "sensor 'imu': rate_hz is 300, expected an integer fraction of the physics rate of 1000 "
      "Hz");
  for (const double rate : {0.0, -200.0, 2000.0, std::nan(""), 1e-12}) {
    config.timing.rate_hz = rate;
    EXPECT_NE(Refusal(config), "") << rate;
  }
  config = {};
  config.timing.latency_s = -0.001;
  EXPECT_EQ(Refusal(config),
            "sensor 'imu': latency_s is -0.001, expected a finite number of at least 0");
  config = {};
  config.gyro.noise_density = -1.0;
  EXPECT_EQ(Refusal(config),
            "sensor 'imu': gyro.noise_density is -1, expected a finite number of at least 0");
  config = {};
  config.accel.bias_time_constant_s = 0.0;
  EXPECT_NE(Refusal(config).find("accel.bias_time_constant_s"), std::string::npos);
  config = {};
  config.accel.g_sensitivity = 0.1;
  EXPECT_NE(Refusal(config).find("accel.g_sensitivity"), std::string::npos);
  config = {};
  config.bandwidth_hz = 501.0;
  EXPECT_NE(Refusal(config).find("bandwidth_hz is 501"), std::string::npos);
  config.bandwidth_hz = 500.0;
  EXPECT_EQ(Refusal(config), "");
  config.bandwidth_poles = 3;
  EXPECT_NE(Refusal(config).find("bandwidth_poles is 3, expected 1 or 2"), std::string::npos);
}

}  // namespace
}  // namespace reckon::sim
