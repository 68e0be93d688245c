#include "reckon/sim/encoders.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::EncoderSample;
using models::Measurement;

constexpr models::TimeNs kMs = 1'000'000;
constexpr double kStepS = 0.001;

Encoders MakeEncoders(const EncoderConfig& config, std::uint64_t seed = 1) {
  return Encoders("wheels", 5, config, seed, kMs);
}

/// Four wheels that spin at 1, 2, 3, 4 times `rate` from `start` on.
std::vector<Measurement> Spin(Encoders& encoders, double rate_rad_s, models::TimeNs end_ns,
                              double start_rad = 0.0) {
  std::vector<Measurement> out;
  for (models::TimeNs t = 0; t <= end_ns; t += kMs) {
    MotionWindow motion;
    motion.t_ns = t;
    motion.step_ns = kMs;
    motion.joint_angle_rad.resize(4);
    for (int i = 0; i < 4; ++i) {
      motion.joint_angle_rad[i] = start_rad + (i + 1) * rate_rad_s * models::Seconds(t);
    }
    motion.joint_rate_rad_s = models::EncoderVector::Constant(4, 1e9);  // must not matter
    encoders.Observe(motion, out);
  }
  return out;
}

const EncoderSample& SampleOf(const Measurement& m) { return std::get<EncoderSample>(m.sample); }

TEST(Encoders, ReportAngleAndMeanRateInOrder) {
  Encoders encoders = MakeEncoders({.timing = {.rate_hz = 50.0, .latency_s = 0.002}});
  const auto out = Spin(encoders, 2.5, 1000 * kMs);
  ASSERT_EQ(out.size(), 50U);
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_EQ(out[n].sensor, 5);
    EXPECT_EQ(out[n].valid_ns, static_cast<models::TimeNs>(n + 1) * 20 * kMs);
    EXPECT_EQ(out[n].arrival_ns, out[n].valid_ns + 2 * kMs);
    EXPECT_EQ(SampleOf(out[n]).interval_ns, 10 * kMs);
    ASSERT_EQ(SampleOf(out[n]).angle_rad.size(), 4);
    for (int i = 0; i < 4; ++i) {
      const double t = models::Seconds(out[n].valid_ns);
      EXPECT_NEAR(SampleOf(out[n]).angle_rad[i], (i + 1) * 2.5 * t, 1e-12);
      EXPECT_NEAR(SampleOf(out[n]).rate_rad_s[i], (i + 1) * 2.5, 1e-10);
    }
  }
}

TEST(Encoders, CountInWholeTicksTowardsMinusInfinity) {
  Encoders encoders = MakeEncoders({.counts_per_rad = 100.0});
  for (const double start : {0.5037, -0.5037}) {
    Encoders fresh = MakeEncoders({.counts_per_rad = 100.0});
    const double angle = SampleOf(Spin(fresh, 0.0, 20 * kMs, start)[0]).angle_rad[0];
    EXPECT_NEAR(angle, start > 0 ? 0.50 : -0.51, 1e-12);
  }
  // A slow wheel: 0.31 counts a window, so that the rate is zero or one count per window, 1 rad/s,
  // and right on average.
  double sum = 0.0;
  const double slow = 0.1 * std::acos(-1.0);  // no beat between counts and samples
  const auto out = Spin(encoders, slow, 20'000 * kMs);
  for (const Measurement& m : out) {
    const double rate = SampleOf(m).rate_rad_s[0];
    EXPECT_TRUE(std::abs(rate) < 1e-9 || std::abs(rate - 1.0) < 1e-9) << rate;
    sum += rate;
  }
  EXPECT_NEAR(sum / static_cast<double>(out.size()), slow, 0.01);
}

TEST(Encoders, RateWindowCanBeTheWholePeriodOrOneStep) {
  for (const double window : {0.001, 0.02}) {
    Encoders encoders = MakeEncoders({.counts_per_rad = 1000.0, .rate_window_s = window});
    const auto out = Spin(encoders, 1.7, 200 * kMs);
    double previous = 0.0;
    for (const Measurement& m : out) {
      EXPECT_EQ(SampleOf(m).interval_ns, static_cast<models::TimeNs>(window * 1e9));
      EXPECT_NEAR(SampleOf(m).rate_rad_s[1], 3.4, 1e-3 / window);  // one count
      if (window == 0.02) {
        // Windows that touch share a reading: rates add up to the angle.
        EXPECT_NEAR(SampleOf(m).angle_rad[1], previous + SampleOf(m).rate_rad_s[1] * window, 1e-12);
        previous = SampleOf(m).angle_rad[1];
      }
    }
  }
}

TEST(Encoders, ScaleAndOffsetAreDrawnOnceAnEncoder) {
  std::vector<double> scales, offsets;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Encoders encoders = MakeEncoders({.offset_rad = 0.2, .scale = 0.01}, seed);
    const auto out = Spin(encoders, 2.0, 40 * kMs);
    for (int i = 0; i < 4; ++i) {
      const EncoderSample& a = SampleOf(out[0]);
      const EncoderSample& b = SampleOf(out[1]);
      EXPECT_NEAR(a.rate_rad_s[i], b.rate_rad_s[i], 1e-10);
      scales.push_back(a.rate_rad_s[i] / (2.0 * (i + 1)) - 1.0);
      offsets.push_back(a.angle_rad[i] - a.rate_rad_s[i] * 0.02);
    }
  }
  using testing_sim::VarianceBand;
  EXPECT_NEAR(testing_sim::Variance(scales), 1e-4, VarianceBand(0.01, scales.size()));
  EXPECT_NEAR(testing_sim::Variance(offsets), 0.04, VarianceBand(0.2, offsets.size()));
  EXPECT_LT(std::abs(testing_sim::Correlation(scales, scales, 1)),
            testing_sim::CorrelationBand(scales.size()));
}

TEST(Encoders, EccentricityIsASineOfTheAngle) {
  Encoders encoders = MakeEncoders({.eccentricity_rad = 0.01});
  double largest = 0.0, sum = 0.0;
  const auto out = Spin(encoders, 2.0 * std::acos(-1.0) / 4.0, 4000 * kMs);  // one turn of wheel 0
  for (const Measurement& m : out) {
    const double error =
        SampleOf(m).angle_rad[0] - 2.0 * std::acos(-1.0) / 4.0 * models::Seconds(m.valid_ns);
    largest = std::max(largest, std::abs(error));
    sum += error;
  }
  EXPECT_NEAR(largest, 0.01, 1e-5);  // 200 samples a turn find the crest to 1 − cos(π/200)
  EXPECT_NEAR(sum, 0.0, 1e-9);
}

TEST(Encoders, NoiseIsWhiteAndEntersBothEndsOfTheWindow) {
  constexpr double kSigma = 1e-3;
  Encoders encoders = MakeEncoders({.noise_rad = kSigma});
  std::vector<double> angle, other, rate;
  for (const Measurement& m : Spin(encoders, 0.0, 400'000 * kMs)) {
    angle.push_back(SampleOf(m).angle_rad[2]);
    other.push_back(SampleOf(m).angle_rad[3]);
    rate.push_back(SampleOf(m).rate_rad_s[2]);
  }
  using namespace testing_sim;
  EXPECT_NEAR(Mean(angle), 0.0, MeanBand(kSigma, angle.size()));
  EXPECT_NEAR(Variance(angle), kSigma * kSigma, VarianceBand(kSigma, angle.size()));
  EXPECT_LT(std::abs(Correlation(angle, angle, 1)), CorrelationBand(angle.size()));
  EXPECT_LT(std::abs(Correlation(angle, other)), CorrelationBand(angle.size()));
  const double sigma_rate = std::sqrt(2.0) * kSigma / 0.01;
  EXPECT_NEAR(Variance(rate), sigma_rate * sigma_rate, VarianceBand(sigma_rate, rate.size()));
}

TEST(Encoders, RateFilterIsOnePole) {
  Encoders encoders =
      MakeEncoders({.timing = {.rate_hz = 500.0}, .rate_window_s = 0.002, .rate_filter_hz = 20.0});
  const auto out = Spin(encoders, 3.0, 40 * kMs);
  ASSERT_EQ(out.size(), 20U);
  for (std::size_t n = 0; n < out.size(); ++n) {
    // From rest, a constant rate: 1 − e^(−2π · 20 Hz · t) of it.
    const double t = 0.002 * static_cast<double>(n + 1);
    const double expected = 3.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * 20.0 * t));
    EXPECT_NEAR(SampleOf(out[n]).rate_rad_s[0], expected, 1e-11);  // rounding of angles over 2 ms
    EXPECT_NEAR(SampleOf(out[n]).angle_rad[0], 3.0 * t, 1e-12);    // the angle is not filtered
  }
}

TEST(Encoders, RefuseAWindowThatDoesNotFit) {
  const auto refusal = [](const EncoderConfig& config) -> std::string {
    try {
      MakeEncoders(config);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.rate_window_s = 0.03}),
            "sensor 'wheels': rate_window_s is 0.03, expected a whole number of physics steps of "
            "0.001 s and at most the sample period of 0.02 s");
  for (const double window : {0.0, -0.01, 0.0015, kStepS / 2, std::nan("")}) {
    EXPECT_NE(refusal({.rate_window_s = window}), "") << window;
  }
  EXPECT_NE(refusal({.counts_per_rad = -1.0}).find("counts_per_rad is -1"), std::string::npos);
  EXPECT_EQ(refusal({}), "");
}

}  // namespace
}  // namespace reckon::sim
