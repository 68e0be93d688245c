#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "reckon/estimator/registry.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/harness/yaml_writer.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;

Scenario Read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return ReadScenarioText(text, "sc.yaml", overrides);
}

const sim::ImuConfig& Imu(const Scenario& scenario, const std::string& name = "imu") {
  return std::get<sim::ImuConfig>(scenario.sensors.at(name).errors);
}

/// The interface's example, with the terrain's keys as they are.
constexpr const char* kExample = R"(
schema: 1
description: A Husky drives a 10 m square twice on grass
robot: husky                       # a folder in models/
duration_s: 60
seed: 1
world:
  terrain: {kind: rough, rms_m: 0.02, shortest_wave_m: 0.6, friction: 0.8}
  patches: [{box_m: [3, 0, 2, 2], friction: 0.15}]
motion: {path: square, side_m: 10, laps: 2, speed_m_s: 0.8}
actual: {wheel_radius_scale: [1.01, 0.99]}      # the simulated robot differs from the nominal one
sensors:                           # the robot's own suite is the default; only changes are written
  imu: {grade: vn100, rate_hz: 200, mode: increment}
faults:
  - {sensor: imu, kind: dropout, at_s: 20, for_s: 0.5}
estimators:                        # all see the same measurements
  riekf: {type: inekf, error: right}
  mekf:  {type: mekf}
  tuned: {type: inekf, noise: {gyro_noise_density_rad_per_s_sqrt_hz: 6.1e-5}}
  mine:  {type: process, command: [python3, my_filter.py]}   # anyone's estimator, on a pipe
score: {align: first_pose, rpe_m: [1, 10]}
expect:
  riekf: {ate_position_rmse_m: {max: 0.30}, consistency: {false_alarm: 1.0e-6}}
  compare: [riekf.ate_position_rmse_m < 0.8 * mekf.ate_position_rmse_m]
)";

TEST(ScenarioRead, TakesTheExample) {
  const Scenario s = Read(kExample);
  EXPECT_EQ(s.world.terrain.kind, sim::TerrainKind::kRough);
  EXPECT_EQ(s.world.terrain.rms_m, 0.02);
  ASSERT_EQ(s.world.patches.size(), 1U);
  EXPECT_EQ(s.world.patches[0].friction, 0.15);
  EXPECT_EQ(s.world.actual.wheel_radius_scale[1], 0.99);
  ASSERT_EQ(s.faults.size(), 1U);
  EXPECT_EQ(s.faults[0].for_s, 0.5);
  ASSERT_EQ(s.estimators.size(), 4U);
  EXPECT_EQ(s.estimators.at("mine").command, (std::vector<std::string>{"python3", "my_filter.py"}));
  const Expectation& expected = s.expect.estimators.at("riekf");
  ASSERT_EQ(expected.bounds.size(), 1U);
  EXPECT_EQ(expected.bounds[0].metric, "ate_position_rmse_m");
  EXPECT_EQ(expected.bounds[0].max, 0.3);
  EXPECT_EQ(expected.consistency_false_alarm, 1e-6);
  ASSERT_EQ(s.expect.compare.size(), 1U);
  EXPECT_EQ(s.expect.compare[0].right_estimator, "mekf");
  EXPECT_EQ(s.expect.compare[0].factor, 0.8);
}

TEST(ScenarioRead, ResolvedTextIsAFixpoint) {
  const std::string once = WriteScenario(Read(kExample));
  const std::string twice = WriteScenario(Read(once));
  EXPECT_EQ(once, twice);
  EXPECT_NE(once.find("robot_defaults: false\n"), std::string::npos);
}

TEST(ScenarioRead, ResolvedTextKeepsEveryValue) {
  // Numbers without a short decimal form, text that needs quotes, a sensor removed and one added.
  const Scenario s = Read(
      "description: 'yes: \"a\"\\n # b'\n"
      "seed: 18446744073709551615\n"
      "motion: {path: velocity_profile, profile: [[0, 0.1, 0.30000000000000004], [1e-9, 0, 0]]}\n"
      "sensors:\n"
      "  wheels: off\n"
      "  velocity: {type: body_velocity, frame: velocity_link, noise_m_per_s: [0.1, 0.2, 0.3]}\n"
      "faults: [{sensor: velocity, kind: scale_step, at_s: 1, factor: -2}]\n"
      "estimators:\n"
      "  a: {noise: matched, gate: {action: 'off'}, mounting_error: {imu: [0, 0, 0, 0, 2, 0]}}\n"
      "expect: {exit_code: 3}\n");
  const Scenario back = Read(WriteScenario(s));
  EXPECT_EQ(back.description, "yes: \"a\"\\n # b");
  EXPECT_EQ(back.seed, 18446744073709551615U);
  EXPECT_EQ(back.world.motion.profile[0][2], 0.30000000000000004);
  EXPECT_EQ(back.world.motion.profile[1][0], 1e-9);
  EXPECT_FALSE(back.sensors.contains("wheels"));
  EXPECT_EQ(std::get<sim::BodyVelocityConfig>(back.sensors.at("velocity").errors).noise_m_per_s,
            Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(back.faults[0].magnitude, -2);
  EXPECT_EQ(back.estimators.at("a").gate.action, estimator::GateAction::kOff);
  EXPECT_EQ(back.estimators.at("a").mounting_error.at("imu")[4], 2);
  EXPECT_EQ(back.estimators.at("a").noise.gyro_noise_density_rad_per_s_sqrt_hz,
            s.estimators.at("a").noise.gyro_noise_density_rad_per_s_sqrt_hz);
  EXPECT_EQ(back.expect.exit_code, 3);
}

TEST(ScenarioRead, ResolvedTextStandsWithoutTheRobotsDefaults) {
  const std::string text = "robot: husky\nseed: 3\n";
  const std::string before = WriteScenario(Read(text));
  // Another home where the same robot has other sensors, another drive and other noise.
  const fs::path robot = fs::path(testing::TempDir()) / "home" / "models" / "husky";
  fs::create_directories(robot);
  fs::copy_file(fs::path(RECKON_SOURCE_DIR) / "models/husky/husky.urdf", robot / "husky.urdf",
                fs::copy_options::overwrite_existing);
  std::ofstream(robot / "robot.yaml")
      << "urdf: husky.urdf\n"
         "drive: {left_joints: [front_left_wheel], right_joints: [front_right_wheel]}\n"
         "sensors: {imu: {type: imu, frame: velocity_link, grade: consumer}}\n";
  ::setenv("RECKON_HOME", robot.parent_path().parent_path().c_str(), 1);
  const std::string other = WriteScenario(Read(text));
  const std::string after = WriteScenario(Read(before));
  ::unsetenv("RECKON_HOME");
  EXPECT_NE(other, before);
  EXPECT_EQ(after, before);
}

TEST(ScenarioRead, LaterLayersWin) {
  const fs::path folder = fs::path(testing::TempDir()) / "layers";
  fs::create_directories(folder / "deep");
  std::ofstream(folder / "deep" / "base.yaml") << "seed: 10\nduration_s: 10\n"
                                                  "sensors: {imu: {rate_hz: 100}}\n"
                                                  "motion: {path: circle, radius_m: 2}\n";
  std::ofstream(folder / "second.yaml") << "include: deep/base.yaml\nseed: 20\nduration_s: 20\n";
  std::ofstream(folder / "third.yaml") << "score: {start_s: 5}\n";
  std::ofstream(folder / "sc.yaml") << "include: [second.yaml, third.yaml]\nseed: 30\n";
  const std::string path = (folder / "sc.yaml").string();
  const Scenario s = ReadScenario(path);
  EXPECT_EQ(s.seed, 30U);                                           // the file
  EXPECT_EQ(s.duration_s, 20);                                      // the file that it includes
  EXPECT_EQ(Imu(s).timing.rate_hz, 100);                            // the file that this includes
  EXPECT_EQ(s.score.start_s, 5);                                    // the second of the list
  EXPECT_EQ(s.sensors.at("imu").frame, "imu_link");                 // the robot
  EXPECT_EQ(s.world.terrain.kind, sim::TerrainKind::kFlat);         // the struct
  EXPECT_EQ(ReadScenario(path, {"seed=40", "seed=50"}).seed, 50U);  // the last override
}

TEST(ScenarioRead, AnotherKindLeavesTheOldKindsKeysBehind) {
  const char* text = "motion: {path: circle, radius_m: 2, speed_m_s: 0.3}\n";
  const Scenario s = Read(text, {"motion.path=square"});
  EXPECT_EQ(s.world.motion.path, sim::PathKind::kSquare);
  EXPECT_EQ(s.world.motion.speed_m_s, 0.3);  // both kinds have it
  // In one layer it is a mistake.
  EXPECT_THROW(Read("motion: {path: square, radius_m: 2}\n"), InputError);
  EXPECT_THROW(Read(text, {"motion.path=square", "motion.radius_m=1"}), InputError);
}

TEST(ScenarioRead, OverridesReachListsAndNewKeys) {
  const Scenario s =
      Read(kExample, {"faults.0.at_s=7", "estimators.extra={type: mekf, noise: matched}",
                      "estimators.extra.gate.action=warn", "world.patches=[]"});
  EXPECT_EQ(s.faults[0].at_s, 7);
  EXPECT_EQ(s.estimators.at("extra").gate.action, estimator::GateAction::kWarn);
  EXPECT_EQ(s.estimators.at("extra").type, "mekf");
  EXPECT_TRUE(s.world.patches.empty());
  // Only white space follows: the value is nothing, which removes a sensor.
  EXPECT_FALSE(Read("seed: 1\n", {"sensors.wheels="}).sensors.contains("wheels"));
}

TEST(ScenarioRead, GradeFillsAndWrittenValuesWin) {
  const Scenario s =
      Read("sensors: {imu: {grade: consumer, gyro: {noise_density_rad_per_s_sqrt_hz: 0.5}}}\n");
  EXPECT_EQ(Imu(s).gyro.noise_density, 0.5);
  EXPECT_NEAR(Imu(s).gyro.range, 500 * M_PI / 180, 1e-12);           // the grade's
  EXPECT_NEAR(Imu(s).accel.noise_density, 400e-6 * 9.80665, 1e-12);  // the grade's
  const Scenario perfect = Read("sensors: {imu: {grade: perfect}}\n");
  EXPECT_EQ(Imu(perfect).gyro.noise_density, 0);
}

TEST(ScenarioRead, NoiseIsNominalMatchedOrGiven) {
  const Scenario s = Read(
      "sensors: {imu: {grade: perfect, rate_hz: 100,\n"
      "  gyro: {noise_density_rad_per_s_sqrt_hz: 3e-4, resolution_rad_per_s: 0.0138564064605510},\n"
      "  accel: {bias_walk_m_per_s3_sqrt_hz: 3, bias_instability_m_per_s2: 4,\n"
      "          bias_time_constant_s: 2}}}\n"
      "nominal: {noise: {wheel_forward_m_per_s: 0.07}}\n"
      "estimators:\n"
      "  plain: {}\n"
      "  matched: {noise: matched}\n"
      "  given: {noise: {gyro_noise_density_rad_per_s_sqrt_hz: 1}}\n");
  const auto& nominal = s.nominal.noise;
  const auto& plain = s.estimators.at("plain").noise;
  const auto& matched = s.estimators.at("matched").noise;
  const auto& given = s.estimators.at("given").noise;
  EXPECT_EQ(plain.gyro_noise_density_rad_per_s_sqrt_hz,
            nominal.gyro_noise_density_rad_per_s_sqrt_hz);
  EXPECT_EQ(plain.wheel_forward_m_per_s, 0.07);
  // 3e-4 and a quantiser of 4e-4 (resolution² / (12 · 100 Hz) = 1.6e-7): a 3-4-5 triangle.
  EXPECT_NEAR(matched.gyro_noise_density_rad_per_s_sqrt_hz, 5e-4, 1e-15);
  // 3 and a Gauss-Markov process driven by 4 √(2/2): another.
  EXPECT_NEAR(matched.accel_bias_walk_m_per_s3_sqrt_hz, 5, 1e-12);
  EXPECT_EQ(matched.wheel_forward_m_per_s, 0.07);  // no sensor's error
  EXPECT_EQ(given.gyro_noise_density_rad_per_s_sqrt_hz, 1);
  EXPECT_EQ(given.wheel_forward_m_per_s, 0.07);  // not given, so nominal
}

TEST(ScenarioRead, EveryNoiseFieldHasAKey) {
  // A field that is added to the filters must be added to the description.
  std::string text = "estimators:\n  a:\n    noise:\n";
  constexpr double kStep = 0.03125;  // all of them within the narrowest bounds, 0 to 1
  double value = kStep;
  for (const auto& field : estimator::NoiseFields()) {
    text += "      " + std::string(field.name) + ": " + std::to_string(value) + "\n";
    value += kStep;
  }
  const Scenario s = Read(text);
  value = kStep;
  for (const auto& field : estimator::NoiseFields()) {
    EXPECT_EQ(s.estimators.at("a").noise.*field.member, value) << field.name;
    value += kStep;
  }
}

TEST(ScenarioRead, EveryFaultHasItsOwnWordForItsSize) {
  const Scenario s = Read(
      "faults:\n"
      "  - {sensor: imu, kind: bias_step, at_s: 1, offset: 2}\n"
      "  - {sensor: imu, kind: saturation, at_s: 1, limit: 3}\n"
      "  - {sensor: imu, kind: extra_delay, at_s: 1, delay_s: 4}\n"
      "  - {sensor: imu, kind: time_jitter, at_s: 1, std_s: 5}\n"
      "  - {sensor: imu, kind: outlier_burst, at_s: 1, std: 6}\n"
      "  - {sensor: imu, kind: stuck, at_s: 1}\n"
      "  - {sensor: imu, kind: nan_burst, at_s: 1}\n");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(s.faults[i].magnitude, i + 2);
}

TEST(ScenarioRead, WithoutEstimatorsThereIsOneAndEmptyMeansNone) {
  EXPECT_EQ(Read("seed: 1\n").estimators.size(), 1U);
  EXPECT_TRUE(Read("estimators: {}\n").estimators.empty());
}

TEST(ScenarioRead, AnotherStepMovesTheDefaultTruthRate) {
  EXPECT_EQ(Read("world: {physics_step_s: 0.0025}\n").record.truth_rate_hz, 400);
  EXPECT_EQ(Read("world: {physics_step_s: 0.0005}\n").record.truth_rate_hz, 1000);
}

TEST(ScenarioRead, AllScenariosAreRight) {
  int read = 0;
  for (const auto& file : ScenarioFiles()) {
    const std::string path = (fs::path(RECKON_SOURCE_DIR) / file).string();
    try {
      ReadScenario(path);
      ++read;
    } catch (const LogMissing&) {
      // A log that is not ours to keep beside the project.
      EXPECT_NE(path.find("/scenarios/logs/"), std::string::npos) << path;
    } catch (const std::exception& error) {
      ADD_FAILURE() << path << ": " << error.what();
    }
  }
  EXPECT_GE(read, 12);  // what scenarios/husky holds
}

TEST(ScenarioRead, NamesComeFromTheScenariosFolder) {
  EXPECT_EQ(ScenarioName("scenarios/husky/square.yaml"), "husky/square");
  EXPECT_EQ(ScenarioName("/a/scenarios/b/scenarios/deep/er/x.yaml"), "deep/er/x");
  EXPECT_EQ(ScenarioName("/tmp/mine.yaml"), "mine");
  EXPECT_EQ(ScenarioName("scenarios.yaml"), "scenarios");
}

}  // namespace
}  // namespace reckon::harness
