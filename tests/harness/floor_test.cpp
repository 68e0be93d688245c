// The noiseless floor: perfect sensors, the filter started at truth, propagation only. What is left
// is the integration's own error, so a wrong frame, lever arm, gravity or stamp shows at once.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "harness/seeds.h"
#include "reckon/estimator/so3.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

constexpr const char* kFloor = R"(
schema: 1
duration_s: 60
sensors: {imu: {grade: perfect, rate_hz: 200}}
initial: {sample_error: false}
estimators: {strapdown: {type: inekf, sensors: [imu]}, mekf: {type: mekf, sensors: [imu]}}
)";

struct Floor {
  double position_m = 0.0, attitude_rad = 0.0;
};

Floor FloorOf(const std::string& motion, const std::vector<std::string>& overrides = {},
              const std::string& estimator = "strapdown") {
  const Scenario scenario = ReadScenarioText(kFloor + motion, "floor.yaml", overrides);
  Floor floor;
  const auto tracks = TracksOf(scenario);
  for (const auto& sample : tracks.at(estimator).samples()) {
    const double position = (sample.X_WB.p - sample.X_WB_true.p).norm();
    const auto turn = estimator::Log(sample.X_WB.R * sample.X_WB_true.R.transpose());
    floor.position_m = std::max(floor.position_m, position);
    floor.attitude_rad = std::max(floor.attitude_rad, turn.norm());
  }
  return floor;
}

constexpr const char* kRough = R"(
world: {terrain: {kind: rough, rms_m: 0.03}}
motion: {path: square, side_m: 6, speed_m_s: 0.8}
)";

constexpr const char* kKerbs = R"(
world: {terrain: {kind: kerbs, kerb_height_m: 0.04}}
motion: {path: waypoints, waypoints_m: [[30, 0]], speed_m_s: 0.6}
)";

TEST(Floor, RoughGround) {
  // Measured 14 µm for this motion; the bound leaves room for rougher draws of the ground.
  const Floor floor = FloorOf(kRough);
  EXPECT_LE(floor.position_m, 1e-4);
  EXPECT_GT(floor.position_m, 0.0);  // the two really are computed apart
  EXPECT_LE(floor.attitude_rad, 1e-9);
  std::cout << "rough: " << 1e6 * floor.position_m << " um, " << floor.attitude_rad << " rad\n";
}

TEST(Floor, Kerbs) {
  const Floor floor = FloorOf(kKerbs);
  EXPECT_LE(floor.position_m, 2e-4);
  EXPECT_LE(floor.attitude_rad, 1e-9);
  std::cout << "kerbs: " << 1e6 * floor.position_m << " um, " << floor.attitude_rad << " rad\n";
}

constexpr const char* kUnderWater = R"(
robot: bluerov2
world: {water: {current: {mean_m_s: [0.1, 0.05, 0], sigma_m_s: 0.05}}}
mission: {kind: helix, speed_m_s: 0.5}
)";

TEST(Floor, UnderWater) {
  const Floor floor = FloorOf(kUnderWater);
  EXPECT_LE(floor.position_m, 2e-5);
  EXPECT_LE(floor.attitude_rad, 1e-9);
  std::cout << "under water: " << 1e6 * floor.position_m << " um, " << floor.attitude_rad
            << " rad\n";
}

TEST(Floor, MultiplicativeFilterHasTheSameMean) {
  const Floor floor = FloorOf(kRough, {}, "mekf");
  EXPECT_LE(floor.position_m, 1e-4);
  EXPECT_LE(floor.attitude_rad, 1e-9);
}

TEST(Floor, RisesWithEachDefect) {
  const auto position = [](const std::string& override_text) {
    return FloorOf(kRough, {override_text}).position_m;
  };
  // Each of these is a mistake of a millimetre, a hundredth of a degree or a part in ten thousand.
  EXPECT_GT(position("estimators.strapdown.mounting_error.imu=[0.001,0,0,0,0,0]"), 3e-4);
  EXPECT_GT(position("estimators.strapdown.mounting_error.imu=[0,0,0,0.01,0,0]"), 1e-2);
  EXPECT_GT(position("sensors.imu.mode=point"), 1e-2);
  EXPECT_GT(position("sensors.imu.stamp_error_s=0.005"), 1e-3);
  EXPECT_GT(position("sensors.imu.accel.noise_density_m_per_s2_sqrt_hz=1e-4"), 1e-3);
}

}  // namespace
}  // namespace reckon::harness
