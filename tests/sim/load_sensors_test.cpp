#include "reckon/sim/load_sensors.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/message.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

constexpr models::TimeNs kMs = 1'000'000;

/// A robot that stands: two joints, two feet.
MotionWindow Standing(models::TimeNs t_ns) {
  MotionWindow motion;
  motion.t_ns = t_ns;
  motion.step_ns = kMs;
  motion.joint_command_n_m.resize(2);
  motion.joint_command_n_m << 12.5, -3.0;
  motion.joint_torque_n_m.resize(2);
  motion.joint_torque_n_m << 10.0, -3.0;  // the first motor can't give more
  motion.feet.count = 2;
  motion.feet.foot[0].normal_n = 44.0;
  return motion;
}

template <class Sensor>
std::vector<models::Measurement> Watch(Sensor& sensor, models::TimeNs end_ns) {
  std::vector<models::Measurement> out;
  for (models::TimeNs t_ns = 0; t_ns <= end_ns; t_ns += kMs) sensor.Observe(Standing(t_ns), out);
  return out;
}

TEST(TorqueSensor, TellsWhatWasAskedForOrWhatWasGiven) {
  TorqueConfig config{.timing = {.rate_hz = 500, .latency_s = 0.004}};
  TorqueSensor measured("torques", 4, config, 1, kMs);
  const auto out = Watch(measured, 10 * kMs);
  ASSERT_EQ(out.size(), 5U);
  EXPECT_EQ(out[0].sensor, 4);
  EXPECT_EQ(out[0].valid_ns, 2 * kMs);
  EXPECT_EQ(out[0].arrival_ns, 6 * kMs);
  EXPECT_EQ(std::get<models::TorqueSample>(out[0].sample).torque_n_m, Eigen::Vector2d(10.0, -3.0));
  config.source = TorqueSource::kCommanded;
  config.errors.noise = 5.0;  // of what is measured alone
  TorqueSensor commanded("torques", 4, config, 1, kMs);
  const auto asked = Watch(commanded, 2 * kMs);
  EXPECT_EQ(std::get<models::TorqueSample>(asked.at(0).sample).torque_n_m,
            Eigen::Vector2d(12.5, -3.0));
}

TEST(TorqueSensor, NoiseIsWhiteAndItsOwnForEachJoint) {
  constexpr double kSigma = 0.3;
  TorqueSensor sensor("torques", 0, {.timing = {.rate_hz = 1000}, .errors = {.noise = kSigma}}, 1,
                      kMs);
  std::vector<double> a, b;
  for (const auto& m : Watch(sensor, 40'000 * kMs)) {
    const auto& torque = std::get<models::TorqueSample>(m.sample).torque_n_m;
    a.push_back(torque[0] - 10.0);
    b.push_back(torque[1] + 3.0);
  }
  ASSERT_EQ(a.size(), 40'000U);
  EXPECT_NEAR(testing_sim::Mean(a), 0.0, testing_sim::MeanBand(kSigma, a.size()));
  EXPECT_NEAR(testing_sim::Variance(a), kSigma * kSigma,
              testing_sim::VarianceBand(kSigma, a.size()));
  EXPECT_LT(std::abs(testing_sim::Correlation(a, a, 1)), testing_sim::CorrelationBand(a.size()));
  EXPECT_LT(std::abs(testing_sim::Correlation(a, b, 0)), testing_sim::CorrelationBand(a.size()));
}

TEST(FootForceSensor, ScalesShiftsClipsAndRounds) {
  FootForceConfig config{.timing = {.rate_hz = 1000}};
  config.errors = {.resolution = 5.0};
  FootForceSensor rounds("feet", 0, config, 1, kMs);
  const auto force = [](const std::vector<models::Measurement>& out) {
    return std::get<models::FootForceSample>(out.at(0).sample).force_n;
  };
  EXPECT_EQ(force(Watch(rounds, kMs)), Eigen::Vector2d(45.0, 0.0));
  config.errors = {.range = 30.0};
  FootForceSensor clips("feet", 0, config, 1, kMs);
  EXPECT_EQ(force(Watch(clips, kMs)), Eigen::Vector2d(30.0, 0.0));
  constexpr double kScale = 0.1, kOffset = 2.0;
  std::vector<double> loaded, free;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    config.errors = {.offset = kOffset, .scale = kScale};
    FootForceSensor off("feet", 0, config, seed, kMs);
    const auto out = Watch(off, 2 * kMs);
    const auto f = force(out);
    EXPECT_EQ(f, std::get<models::FootForceSample>(out.at(1).sample).force_n);  // once a run
    loaded.push_back(f[0] - 44.0);
    free.push_back(f[1]);
  }
  const double sigma = std::hypot(44.0 * kScale, kOffset);
  EXPECT_NEAR(testing_sim::Variance(free), kOffset * kOffset,
              testing_sim::VarianceBand(kOffset, free.size()));
  EXPECT_NEAR(testing_sim::Variance(loaded), sigma * sigma,
              testing_sim::VarianceBand(sigma, loaded.size()));
}

TEST(LoadSensors, RefuseNegativeNumbersByName) {
  const std::string message = testing_sim::Message<std::invalid_argument>([] {
    const TorqueSensor bad("torques", 0, {.timing = {.rate_hz = 500}, .errors = {.offset = -1.0}},
                           1, kMs);
  });
  EXPECT_NE(message.find("'torques': offset_n_m is -1"), std::string::npos) << message;
}

}  // namespace
}  // namespace reckon::sim
