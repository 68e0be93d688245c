#include "reckon/sim/sensor_suite.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reckon/sim/imu_grades.h"
#include "sim/analytic_motion.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::Measurement;
using testing_sim::RoughRide;
using testing_sim::SlantedMounting;
using testing_sim::WindowAt;

constexpr models::TimeNs kMs = 1'000'000;

SensorSpec ImuSpec(const std::string& name, double rate_hz = 200.0) {
  ImuConfig config;
  config.timing.rate_hz = rate_hz;
  config.gyro = FindImuGrade("consumer")->gyro;
  config.accel = FindImuGrade("consumer")->accel;
  config.gyro.bias_walk = 1e-4;
  config.accel.bias_instability = 1e-3;
  return {name, 0, SlantedMounting(), config};
}

SensorSpec EncoderSpec() {
  EncoderConfig config;
  config.counts_per_rad = 12837.0;
  config.noise_rad = 1e-4;
  config.scale = 0.01;
  return {"wheels", 1, {}, config};
}

SensorSpec VelocitySpec() {
  BodyVelocityConfig config;
  config.noise_m_per_s.setConstant(0.01);
  return {"velocity", 2, SlantedMounting(), config};
}

SensorSpec DepthSpec() {
  return {"depth", 3, SlantedMounting(), DepthConfig{.noise_m = 0.01, .offset_m = 0.1}};
}

SensorSpec PoseSpec() {
  PoseConfig config;
  config.noise_position_m.setConstant(0.01);
  config.noise_orientation_rad.setConstant(0.01);
  return {"gps", 4, SlantedMounting(), config};
}

/// All messages of the sensor `id` over two seconds of a rough ride.
std::vector<Measurement> MessagesOf(models::SensorId id, const std::vector<SensorSpec>& sensors,
                                    const std::vector<FaultConfig>& faults = {},
                                    std::uint64_t seed = 1) {
  SensorSuite suite(sensors, faults, seed, Environment{});
  std::vector<Measurement> all, out;
  for (models::TimeNs t = 0; t <= 2000 * kMs; t += kMs) {
    MotionWindow motion = WindowAt(RoughRide{}, t, kMs);
    motion.joint_angle_rad.setConstant(4, 5.0 * models::Seconds(t));
    motion.joint_rate_rad_s.setConstant(4, 5.0);
    suite.Observe(motion, all);
  }
  for (const Measurement& m : all) {
    if (m.sensor == id) out.push_back(m);
  }
  return out;
}

bool SameBits(const models::ImuSample& a, const models::ImuSample& b) {
  return a.gyro_rad_s == b.gyro_rad_s && a.accel_m_s2 == b.accel_m_s2 &&
         a.interval_ns == b.interval_ns;
}
bool SameBits(const models::EncoderSample& a, const models::EncoderSample& b) {
  return a.angle_rad == b.angle_rad && a.rate_rad_s == b.rate_rad_s;
}
bool SameBits(const models::BodyVelocitySample& a, const models::BodyVelocitySample& b) {
  return a.v_WS_S == b.v_WS_S;
}
bool SameBits(const models::DepthSample& a, const models::DepthSample& b) {
  return a.depth_m == b.depth_m;
}
bool SameBits(const models::PoseSample& a, const models::PoseSample& b) {
  return a.X_WS.R == b.X_WS.R && a.X_WS.p == b.X_WS.p;
}
bool SameBits(const models::ContactSample& a, const models::ContactSample& b) {
  return a.probability == b.probability;
}
bool SameBits(const models::TorqueSample& a, const models::TorqueSample& b) {
  return a.torque_n_m == b.torque_n_m;
}
bool SameBits(const models::FootForceSample& a, const models::FootForceSample& b) {
  return a.force_n == b.force_n;
}

bool SameBits(const std::vector<Measurement>& a, const std::vector<Measurement>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const bool same = std::visit(
        [&](const auto& sample) {
          return SameBits(sample, std::get<std::decay_t<decltype(sample)>>(b[n].sample));
        },
        a[n].sample);
    if (!same || a[n].valid_ns != b[n].valid_ns || a[n].arrival_ns != b[n].arrival_ns) return false;
  }
  return true;
}

TEST(SensorSuite, MessagesCarryTheirSensorsId) {
  const std::vector<SensorSpec> sensors{ImuSpec("imu"), EncoderSpec(), VelocitySpec(), DepthSpec(),
                                        PoseSpec()};
  EXPECT_EQ(MessagesOf(0, sensors).size(), 400U);
  EXPECT_EQ(MessagesOf(1, sensors).size(), 100U);
  EXPECT_EQ(MessagesOf(2, sensors).size(), 40U);
  EXPECT_EQ(MessagesOf(3, sensors).size(), 20U);
  EXPECT_EQ(MessagesOf(4, sensors).size(), 20U);
}

TEST(SensorSuite, AddingOrChangingASensorLeavesTheOthersBitIdentical) {
  SensorSpec second = ImuSpec("imu_2", 500.0);
  second.id = 5;
  const std::vector<SensorSpec> few{ImuSpec("imu"), EncoderSpec(), VelocitySpec(), DepthSpec(),
                                    PoseSpec()};
  const std::vector<SensorSpec> many{second,         PoseSpec(),     DepthSpec(),
                                     VelocitySpec(), ImuSpec("imu"), EncoderSpec()};
  const FaultConfig fault{.sensor = "imu_2", .kind = FaultKind::kOutlierBurst, .magnitude = 1.0};
  for (models::SensorId id = 0; id < few.size(); ++id) {
    const auto expected = MessagesOf(id, few);
    EXPECT_TRUE(SameBits(MessagesOf(id, many, {fault}), expected)) << "sensor " << id;
    EXPECT_FALSE(SameBits(MessagesOf(id, few, {}, 2), expected)) << "control: another seed";
  }
  SensorSpec renamed = ImuSpec("other");
  EXPECT_FALSE(SameBits(MessagesOf(0, {renamed}), MessagesOf(0, few))) << "control: another name";
}

TEST(SensorSuite, StreamsOfDifferentSensorsAreIndependent) {
  constexpr std::size_t kCount = 50'000;
  std::vector<SensorSpec> sensors{ImuSpec("a"), ImuSpec("b")};
  sensors[1].id = 1;
  for (SensorSpec& spec : sensors) {
    auto& config = std::get<ImuConfig>(spec.errors);
    config.gyro = {.noise_density = 1.0};
    config.accel = {.noise_density = 1.0};
  }
  SensorSuite suite(sensors, {}, 1, Environment{.step_ns = 5'000'000});
  std::vector<std::vector<double>> channels(12, std::vector<double>(kCount));
  std::vector<Measurement> out;
  for (std::size_t n = 0; n <= kCount; ++n) {
    out.clear();
    const auto t_ns = static_cast<models::TimeNs>(n) * 5 * kMs;
    suite.Observe(WindowAt(testing_sim::Rest{}, t_ns, 5 * kMs), out);
    for (const Measurement& m : out) {
      const auto& sample = std::get<models::ImuSample>(m.sample);
      for (int i = 0; i < 3; ++i) {
        const auto channel = static_cast<std::size_t>(6 * m.sensor + i);
        channels[channel][n - 1] = sample.gyro_rad_s[i];
        channels[channel + 3][n - 1] = sample.accel_m_s2[i];
      }
    }
  }
  for (std::size_t a = 0; a < 12; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_LT(std::abs(testing_sim::Correlation(channels[a], channels[b])),
                testing_sim::CorrelationBand(kCount))
          << a << ", " << b;
    }
  }
}

TEST(SensorSuite, KnowsTheTrueBiasesInTheBodysAxes) {
  ImuConfig config;
  config.gyro.turn_on_bias = 0.1;
  config.accel.bias_walk = 0.5;
  const std::vector<SensorSpec> sensors{EncoderSpec(), {"imu", 0, SlantedMounting(), config}};
  SensorSuite suite(sensors, {}, 1, Environment{});
  const Eigen::Matrix3d R_BS = SlantedMounting().R;
  std::vector<Measurement> out;
  for (models::TimeNs t = 0; t <= 100 * kMs; t += kMs) {
    const Eigen::Vector3d gyro = suite.gyro_bias(), accel = suite.accel_bias();
    out.clear();
    MotionWindow motion = WindowAt(testing_sim::Rest{}, t, kMs);
    motion.joint_angle_rad.setZero(4);
    suite.Observe(motion, out);
    if (out.empty()) continue;
    // At rest the body-axes reading is the bias, plus gravity.
    const auto& sample = std::get<models::ImuSample>(out.back().sample);
    const Eigen::Vector3d up(0, 0, 9.81);
    EXPECT_LT((R_BS * sample.gyro_rad_s - gyro).norm(), 1e-14);
    EXPECT_LT((R_BS * sample.accel_m_s2 - up - accel).norm(), 1e-12);
    EXPECT_GT((suite.accel_bias() - accel).norm(), 0.0);  // it walked on
  }
  EXPECT_GT(suite.gyro_bias().norm(), 1e-3);
  EXPECT_EQ(SensorSuite({}, {}, 1, Environment{}).gyro_bias(), Eigen::Vector3d::Zero());
}

TEST(SensorSuite, AppliesFaultsToTheNamedSensor) {
  const std::vector<SensorSpec> sensors{ImuSpec("imu"), EncoderSpec()};
  const std::vector<FaultConfig> faults{
      {.sensor = "wheels", .kind = FaultKind::kDropout, .at_s = 1.0, .for_s = 0.5}};
  EXPECT_EQ(MessagesOf(1, sensors, faults).size(), 75U);
  EXPECT_EQ(MessagesOf(0, sensors, faults).size(), 400U);
}

TEST(SensorSuite, RefusesDuplicateNamesUnknownFaultTargetsAndOddSteps) {
  const auto refusal = [](const std::vector<SensorSpec>& sensors,
                          const std::vector<FaultConfig>& faults,
                          models::TimeNs step_ns) -> std::string {
    try {
      SensorSuite(sensors, faults, 1, Environment{.step_ns = step_ns});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({ImuSpec("imu"), ImuSpec("imu")}, {}, 1'000'000),
            "two sensors are called 'imu'");
  const std::vector<FaultConfig> faults{{.sensor = "lidar"}};
  EXPECT_EQ(refusal({ImuSpec("imu")}, faults, 1'000'000),
            "a fault names the sensor 'lidar', which the robot does not have");
  const std::vector<FaultConfig> rate_of_imu{{.sensor = "imu", .channels = FaultChannels::kRate}};
  EXPECT_EQ(refusal({ImuSpec("imu")}, rate_of_imu, 1'000'000),
            "a fault strikes the channels 'rate' of 'imu', which that sensor does not have");
  const std::vector<FaultConfig> gyro{{.sensor = "imu", .channels = FaultChannels::kGyro}};
  EXPECT_EQ(refusal({ImuSpec("imu")}, gyro, 1'000'000), "");
  EXPECT_NE(refusal({}, {}, 0), "");
  EXPECT_NE(refusal({}, {}, 1'000'000'001), "");
  EXPECT_EQ(refusal({ImuSpec("imu")}, {}, 1'000'000), "");
}

}  // namespace
}  // namespace reckon::sim
