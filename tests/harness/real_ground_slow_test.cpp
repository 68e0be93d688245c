// How honest the filter is on real tyres and rough ground, and what its believed noise stands on.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "harness/seeds.h"
#include "reckon/ground_truth/consistency.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/sim/sensor_suite.h"
#include "reckon/sim/world.h"

namespace reckon::harness {
namespace {

constexpr int kSeeds = 50;

constexpr const char* kRealGround = R"(
schema: 1
duration_s: 60
world: {terrain: {kind: rough, rms_m: 0.03}}
motion: {path: square, side_m: 6, speed_m_s: 0.8}
estimators: {riekf: {type: inekf}, mekf: {type: mekf}}
)";

/// ANEES of each block over all seeds and ten times.
using BlockMeans = std::array<double, ground_truth::kNeesBlocks>;

TEST(RealGround, AneesStaysInTheEngineeringBand) {
  std::map<std::string, BlockMeans> anees;
  ForSeeds(ReadScenarioText(kRealGround, "real_ground.yaml"), kSeeds, [&](int, const auto& tracks) {
    for (const auto& [name, track] : tracks) {
      for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
        anees[name][static_cast<std::size_t>(block)] +=
            NeesAtTimes(track, block, 10).mean() / kSeeds;
      }
    }
  });
  for (const auto& [name, means] : anees) {
    for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
      const double mean = means[static_cast<std::size_t>(block)];
      std::cout << name << " " << ground_truth::NeesBlockName(block) << " " << mean << "\n";
      // Position and with it the full error drift with biased slip: reported, not gated.
      if (block == ground_truth::kNeesPosition || block == ground_truth::kNeesFull) continue;
      EXPECT_GE(mean, 0.5 * 3) << name << " " << ground_truth::NeesBlockName(block);
      EXPECT_LE(mean, 2.0 * 3) << name << " " << ground_truth::NeesBlockName(block);
    }
  }
}

/// What the wheels get wrong, row by row in the drive's frame, at the encoders' rate.
std::vector<Eigen::Vector3d> SlipOf(const Scenario& scenario) {
  const Robot robot = LoadRobot(scenario);
  const models::WheelDrive& drive = *robot.nominal.wheels;
  sim::World world(robot.simulated, scenario.world, scenario.seed);
  sim::SensorSuite sensors(robot.sensors, {}, scenario.seed, world.environment());
  std::vector<models::Measurement> sent;
  std::vector<Eigen::Vector3d> slip;
  while (world.motion().t_ns < 60 * models::kNsPerSecond) {
    world.Advance();
    sent.clear();
    sensors.Observe(world.motion(), sent);
    for (const auto& measurement : sent) {
      const auto* encoders = std::get_if<models::EncoderSample>(&measurement.sample);
      if (encoders == nullptr || measurement.valid_ns < 3 * models::kNsPerSecond) continue;
      const Eigen::Vector3d v =
          world.motion().X_WB.R.transpose() * world.motion().Velocity(drive.X_BS.p);
      const double speed = drive.rolling_radius_m * encoders->rate_rad_s.mean();
      slip.push_back(Eigen::Vector3d(speed, 0, 0) - v);
    }
  }
  return slip;
}

/// Variance about zero, and the correlation time: where the autocorrelation falls below 1/e.
struct Slip {
  double variance = 0.0, time_s = 0.0;
};

Slip Measure(const std::vector<Eigen::Vector3d>& slip, int row, double period_s) {
  const auto product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < slip.size(); ++k) sum += slip[k][row] * slip[k + lag][row];
    return sum / static_cast<double>(slip.size() - lag);
  };
  Slip measured;
  measured.variance = product(0);
  std::size_t lag = 1;
  while (lag < slip.size() / 2 && product(lag) > measured.variance / std::exp(1.0)) ++lag;
  measured.time_s = static_cast<double>(lag) * period_s;
  return measured;
}

TEST(RealGround, BelievedWheelNoiseIsAtMostTwiceTheSlipPower) {
  Scenario scenario = ReadScenarioText(kRealGround, "real_ground.yaml");
  const auto& noise = scenario.nominal.noise;
  const std::array<double, 3> believed{noise.wheel_forward_m_per_s, noise.wheel_lateral_m_per_s,
                                       noise.wheel_vertical_m_per_s};
  const double rate_hz =
      std::get<sim::EncoderConfig>(scenario.sensors.at("wheels").errors).timing.rate_hz;
  constexpr int kGrounds = 10;
  std::array<double, 3> power{};  // 2 τ · rate · sd², mean over the grounds
  for (int seed = 1; seed <= kGrounds; ++seed) {
    scenario.seed = static_cast<std::uint64_t>(seed);
    const auto slip = SlipOf(scenario);
    for (int row = 0; row < 3; ++row) {
      const Slip s = Measure(slip, row, 1.0 / rate_hz);
      power[static_cast<std::size_t>(row)] += 2.0 * s.time_s * rate_hz * s.variance / kGrounds;
      if (seed == 1) {
        std::cout << "row " << row << ": sd " << std::sqrt(s.variance) << " m/s, tau " << s.time_s
                  << " s\n";
      }
    }
  }
  for (std::size_t row = 0; row < 3; ++row) {
    std::cout << "row " << row << ": believed " << believed[row] * believed[row] << ", slip power "
              << power[row] << " m2/s2\n";
    EXPECT_LE(believed[row] * believed[row], 2.0 * power[row]) << "row " << row;
  }
}

}  // namespace
}  // namespace reckon::harness
