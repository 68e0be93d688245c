// What a wrong scenario is answered with: file:line:column, key, what was found and expected.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

std::string MessageOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    ReadScenarioText(text, "sc.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Case {
  const char* name;
  const char* text;
  const char* message;
};

class WrongText : public testing::TestWithParam<Case> {};

TEST_P(WrongText, IsExplained) { EXPECT_EQ(MessageOf(GetParam().text), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    Scenario, WrongText,
    testing::Values(
        Case{"UnknownKey", "robot: husky\nsensors:\n  imu:\n    gyro:\n      scael: 1\n",
             "sc.yaml:5:7: error: unknown key 'scael' in '/sensors/imu/gyro'; did you mean "
             "'scale'?"},
        Case{"UnknownTopKey", "sede: 3\n",
             "sc.yaml:1:1: error: unknown key 'sede' in '/'; did you mean 'seed'?"},
        Case{"KeyOfALaterVersion", "video: {camera: chase}\n",
             "sc.yaml:1:1: error: unknown key 'video' in '/'"},
        Case{"KeyOfAnotherKind", "world:\n  terrain: {kind: flat, rms_m: 0.1}\n",
             "sc.yaml:2:25: error: key 'rms_m' in '/world/terrain' belongs to kind 'rough', not to "
             "'flat'"},
        Case{"KeyTwice", "seed: 1\nrobot: husky\nseed: 2\n",
             "sc.yaml:3:1: error: key 'seed' is written twice; the first is at line 1"},
        Case{"SensorTwice", "sensors:\n  imu: {rate_hz: 100}\n  imu: {rate_hz: 200}\n",
             "sc.yaml:3:3: error: key 'imu' is written twice; the first is at line 2"},
        Case{"TextForNumber", "duration_s: long\n",
             "sc.yaml:1:13: error: '/duration_s': expected a finite number above 0 and at most "
             "100000, found 'long'"},
        Case{"QuotedNumber", "duration_s: '60'\n",
             "sc.yaml:1:13: error: '/duration_s': expected a finite number above 0 and at most "
             "100000, found '60'"},
        Case{"NumberForText", "robot: 7\n",
             "sc.yaml:1:8: error: '/robot': expected text (in quotes, if it looks like a number), "
             "found '7'"},
        Case{"MapForNumber", "seed: {a: 1}\n",
             "sc.yaml:1:7: error: '/seed': expected a whole number of at least 0, found a map"},
        Case{"NothingForMap", "world:\nseed: 1\n",
             "sc.yaml:1:1: error: '/world': expected a map, found nothing"},
        Case{"FractionForWhole", "seed: 1.5\n",
             "sc.yaml:1:7: error: '/seed': expected a whole number of at least 0, found '1.5'"},
        Case{"ListTooShort", "actual: {wheel_radius_scale: [1]}\n",
             "sc.yaml:1:30: error: '/actual/wheel_radius_scale': expected a list of 2 values, "
             "found 1"},
        Case{"NegativeDuration", "duration_s: -60\n",
             "sc.yaml:1:13: error: '/duration_s': expected a finite number above 0 and at most "
             "100000, found '-60'"},
        Case{"WrongUnit", "world: {physics_step_s: 1}   # milliseconds\n",
             "sc.yaml:1:25: error: '/world/physics_step_s': expected a finite number from 1e-05 "
             "to 0.005, found '1'"},
        Case{"NaN", "motion: {path: square, speed_m_s: .nan}\n",
             "sc.yaml:1:35: error: '/motion/speed_m_s': expected a finite number above 0 and at "
             "most 20, found '.nan'"},
        Case{"PlainNaN", "motion: {path: square, speed_m_s: nan}\n",
             "sc.yaml:1:35: error: '/motion/speed_m_s': expected a finite number above 0 and at "
             "most 20, found 'nan'"},
        Case{"Overflow", "motion: {path: square, speed_m_s: 1e999}\n",
             "sc.yaml:1:35: error: '/motion/speed_m_s': expected a finite number above 0 and at "
             "most 20, found '1e999'"},
        Case{"Empty", "", "sc.yaml: error: the file is empty"},
        Case{"OnlyAComment", "# nothing\n", "sc.yaml: error: the file is empty"},
        Case{"NotAMap", "- a\n- b\n", "sc.yaml:1:1: error: expected a map of keys, found a list"},
        Case{"SyntaxError", "seed: [1, 2\nrobot: husky\n",
             "sc.yaml:2:6: error: not YAML: end of sequence flow not found"},
        Case{"SeveralDocuments", "seed: 1\n---\nseed: 2\n",
             "sc.yaml:2:1: error: expected the end of the file, found another YAML document"},
        // yaml-cpp finds documents without end behind this comma.
        Case{"StrayComma", "{seed: 1}, robot\n",
             "sc.yaml:1:10: error: expected the end of the file, found another YAML document"},
        Case{"AnchorInItself", "description: &a [*a]\n",
             "sc.yaml:1:18: error: an anchor can't hold itself"},
        Case{"ListAsKey", "? [a]\n: 1\n",
             "sc.yaml:1:3: error: expected a word as key, found a list"},
        Case{"Tag", "seed: !!int 1\n",
             "sc.yaml:1:7: error: tags such as 'tag:yaml.org,2002:int' have no meaning here"},
        Case{"ControlCharacter", "seed: 1\nrobot: hus\x04ky\n",
             "sc.yaml:2:11: error: a control character"},
        Case{"NotUtf8", "description: \xff\n", "sc.yaml:1:14: error: not UTF-8 text"},
        Case{"UnknownRobot", "robot: huskie\n",
             "sc.yaml:1:8: error: '/robot': there is no robot 'huskie' in models/; did you mean "
             "'husky'?"},
        Case{"RobotOutsideModels", "robot: ../models/husky\n",
             "sc.yaml:1:8: error: '/robot': there is no robot '../models/husky' in models/"},
        Case{"UnknownTerrain", "world: {terrain: {kind: ruogh}}\n",
             "sc.yaml:1:25: error: '/world/terrain/kind': expected flat, slope, rough, kerbs, "
             "stairs, debris or gravel, "
             "found 'ruogh'; did you mean 'rough'?"},
        Case{"NewSensorWithoutFrame", "sensors: {dvl: {type: body_velocity}}\n",
             "sc.yaml:1:16: error: '/sensors/dvl' needs the key 'frame'"},
        Case{"UnknownFrame", "sensors: {imu: {frame: imu_lnk}}\n",
             "sc.yaml:1:24: error: '/sensors/imu/frame': there is no link in the URDF called "
             "'imu_lnk'; did you mean 'imu_link'?"},
        Case{"BadSensorName", "sensors: {my imu: {type: imu, frame: imu_link}}\n",
             "sc.yaml:1:11: error: 'my imu' in '/sensors': expected a name of at most 64 letters, "
             "digits, '_' and '-'"},
        Case{"RateThatDoesNotDivide", "sensors: {imu: {rate_hz: 300}}\n",
             "sc.yaml:1:26: error: '/sensors/imu/rate_hz': expected an integer fraction of the "
             "physics rate of 1000 Hz, found 300; the nearest is 333.3333333333333"},
        Case{"StepOfHalfNanoseconds", "world: {physics_step_s: 0.0010000005}\n",
             "sc.yaml:1:25: error: '/world/physics_step_s': expected a whole number of "
             "nanoseconds, found '0.0010000005'"},
        Case{"WindowBetweenSteps", "sensors: {wheels: {rate_window_s: 0.0105}}\n",
             "sc.yaml:1:35: error: '/sensors/wheels/rate_window_s': expected a whole number of "
             "physics steps, found '0.0105'"},
        Case{"FaultOnNoSensor", "faults:\n  - {sensor: wheel, kind: dropout, at_s: 1}\n",
             "sc.yaml:2:14: error: '/faults/0/sensor': there is no sensor 'wheel'; did you mean "
             "'wheels'?"},
        Case{"FaultWithoutSize", "faults:\n  - {sensor: imu, kind: extra_delay, at_s: 1}\n",
             "sc.yaml:2:5: error: '/faults/0' needs the key 'delay_s'"},
        Case{
            "FaultWithAnothersSize",
            "faults:\n  - {sensor: imu, kind: dropout, at_s: 1, factor: 2}\n",
            "sc.yaml:2:43: error: key 'factor' in '/faults/0' belongs to kind 'scale_step', not to "
            "'dropout'"},
        Case{"FaultAfterTheEnd",
             "duration_s: 5\nfaults:\n  - {sensor: imu, kind: dropout, at_s: 6}\n",
             "sc.yaml:3:40: error: '/faults/0/at_s': expected a time before the run's end, found "
             "'6'"},
        Case{"NoWaypoints", "motion: {path: waypoints}\n",
             "sc.yaml:1:9: error: '/motion/waypoints_m': expected at least one point [x, y] "
             "other than the origin"},
        Case{"ProfileGoesBack",
             "motion: {path: velocity_profile, profile: [[1, 0, 0], [1, 0, 0]]}\n",
             "sc.yaml:1:56: error: '/motion/profile/1/0': expected times of at least 0 that rise, "
             "found '1'"},
        Case{"UnknownEstimator", "estimators: {a: {type: inekff}}\n",
             "sc.yaml:1:24: error: '/estimators/a/type': expected inekf, iterated_inekf, mekf, "
             "odometry or process, "
             "found 'inekff'; did you mean 'inekf'?"},
        Case{"UnknownError", "estimators: {a: {type: inekf, error: lefft}}\n",
             "sc.yaml:1:38: error: '/estimators/a/error': expected right or left, found 'lefft'; "
             "did you mean 'left'?"},
        Case{"ErrorOfMekf", "estimators: {a: {type: mekf, error: right}}\n",
             "sc.yaml:1:30: error: key 'error' in '/estimators/a' belongs to type 'inekf', not to "
             "'mekf'"},
        Case{"ProcessWithoutCommand", "estimators: {a: {type: process}}\n",
             "sc.yaml:1:17: error: '/estimators/a' needs the key 'command'"},
        Case{"NameTaken", "estimators: {truth: {type: inekf}}\n",
             "sc.yaml:1:21: error: '/estimators/truth': this name is taken; choose another for the "
             "estimator"},
        Case{"OdometryWithoutWheels",
             "sensors: {wheels: off}\nestimators: {odo: {type: odometry}}\n",
             "sc.yaml:2:19: error: '/estimators/odo': type 'odometry' needs wheel encoders, and "
             "this robot has none"},
        Case{"FilterWithoutImu", "sensors: {imu: off}\nestimators: {a: {type: mekf}}\n",
             "sc.yaml:2:17: error: '/estimators/a': type 'mekf' needs an IMU, and is given none"},
        Case{"FilterNotGivenImu", "estimators: {a: {type: mekf, sensors: [wheels]}}\n",
             "sc.yaml:1:17: error: '/estimators/a': type 'mekf' needs an IMU, and is given none"},
        Case{"ExpectationOfNobody",
             "estimators: {riekf: {}}\nexpect:\n  reikf: {ate_position_rmse_m: {max: 1}}\n",
             "sc.yaml:3:10: error: '/expect/reikf': there is no estimator 'reikf'; did you mean "
             "'riekf'?"},
        Case{"UnknownMetric",
             "estimators: {riekf: {}}\nexpect:\n  riekf: {ate_positon_rmse_m: {max: 1}}\n",
             "sc.yaml:3:31: error: '/expect/riekf/ate_positon_rmse_m': there is no metric "
             "'ate_positon_rmse_m'; did you mean 'ate_position_rmse_m'?"},
        Case{"BoundWithoutNumber",
             "estimators: {riekf: {}}\nexpect:\n  riekf: {ate_position_rmse_m: {}}\n",
             "sc.yaml:3:32: error: '/expect/riekf/ate_position_rmse_m': expected a bound `min` or "
             "`max`, found a map"},
        Case{"BadComparison", "expect: {compare: [a is better than b]}\n",
             "sc.yaml:1:20: error: '/expect/compare/0': expected a comparison such as "
             "`riekf.final_drift_m < 0.8 * mekf.final_drift_m`, found 'a is better than b'"},
        Case{"MissingInclude", "include: base.yaml\n",
             "sc.yaml:1:10: error: '/include': there is no file 'base.yaml'"}),
    [](const auto& test) { return test.param.name; });

// What only the simulator would refuse, if the reader did not.
INSTANTIATE_TEST_SUITE_P(
    Simulator, WrongText,
    testing::Values(
        Case{"RoughMapTooLarge", "world: {terrain: {kind: rough, half_size_m: 900}}\n",
             "sc.yaml:1:45: error: '/world/terrain/half_size_m': expected a finite number from 2 "
             "to 150, found '900'"},
        Case{"WavesTooShort", "world: {terrain: {kind: rough, shortest_wave_m: 0.3}}\n",
             "sc.yaml:1:49: error: '/world/terrain/shortest_wave_m': expected a finite number from "
             "0.4 to 1000, found '0.3'"},
        Case{"WavesCross", "world: {terrain: {kind: rough, longest_wave_m: 0.5}}\n",
             "sc.yaml:1:48: error: '/world/terrain/longest_wave_m': expected at least "
             "shortest_wave_m, 0.6, found '0.5'"},
        Case{"KerbTooHigh", "world: {terrain: {kind: kerbs, kerb_height_m: 0.3}}\n",
             "sc.yaml:1:47: error: '/world/terrain/kerb_height_m': expected a finite number from "
             "0.001 to 0.12, found '0.3'"},
        Case{"KerbsTooClose", "world: {terrain: {kind: kerbs, kerb_spacing_m: 0.5}}\n",
             "sc.yaml:1:48: error: '/world/terrain/kerb_spacing_m': expected at least 1.8, the "
             "kerb's width and room for the robot, found '0.5'"},
        Case{"NoGravity", "world: {gravity_m_s2: 0}\n",
             "sc.yaml:1:23: error: '/world/gravity_m_s2': expected a finite number above 0 and at "
             "most 30, found '0'"},
        Case{"BandwidthBeyondThePhysics", "sensors:\n  imu: {bandwidth_hz: 800}\n",
             "sc.yaml:2:23: error: '/sensors/imu/bandwidth_hz': expected at most half the physics "
             "rate, 500 Hz, found '800'"},
        Case{"WindowBeyondThePeriod", "sensors:\n  wheels: {rate_window_s: 0.5}\n",
             "sc.yaml:2:27: error: '/sensors/wheels/rate_window_s': expected at most the sample "
             "period of 0.02 s, found '0.5'"},
        Case{"WheelThatDoesNotTurn", "drive: {left_joints: [imu_joint]}\n",
             "sc.yaml:1:23: error: '/drive/left_joints/0': expected a continuous joint of "
             "base_link (front_left_wheel, front_right_wheel, rear_left_wheel, rear_right_wheel), "
             "found 'imu_joint'"},
        Case{"WaypointsAtTheStart", "motion: {path: waypoints, waypoints_m: [[0, 0]]}\n",
             "sc.yaml:1:40: error: '/motion/waypoints_m': expected at least one point [x, y] other "
             "than the origin, found a list"},
        Case{"DelayOfNothing",
             "faults:\n  - {sensor: imu, kind: extra_delay, at_s: 1, delay_s: 0}\n",
             "sc.yaml:2:56: error: '/faults/0/delay_s': expected a finite number above 0 and at "
             "most 60, found '0'"},
        Case{"JitterOfNothing",
             "faults:\n  - {sensor: imu, kind: time_jitter, at_s: 1, std_s: 0}\n",
             "sc.yaml:2:54: error: '/faults/0/std_s': expected a finite number above 0 and at most "
             "10, found '0'"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    FaultChannels, WrongText,
    testing::Values(
        Case{"OfEncodersOnAnImu",
             "faults:\n  - {sensor: imu, kind: bias_step, at_s: 1, offset: 1, channels: rate}\n",
             "sc.yaml:2:66: error: '/faults/0/channels': expected channels of the sensor 'imu' "
             "(all, gyro, accel), found 'rate'"},
        Case{"OfAnImuOnEncoders",
             "faults:\n  - {sensor: wheels, kind: nan_burst, at_s: 1, channels: gyro}\n",
             "sc.yaml:2:58: error: '/faults/0/channels': expected channels of the sensor 'wheels' "
             "(all, angle, rate), found 'gyro'"},
        Case{
            "OfASensorThatHasOnlyOne",
            "sensors: {v: {type: body_velocity, frame: velocity_link}}\n"
            "faults:\n  - {sensor: v, kind: saturation, at_s: 1, limit: 1, channels: accel}\n",
            "sc.yaml:3:64: error: '/faults/0/channels': expected channels of the sensor 'v' (all), "
            "found 'accel'"},
        Case{"OfNoSensor",
             "faults:\n  - {sensor: imu, kind: scale_step, at_s: 1, factor: 2, channels: gyr}\n",
             "sc.yaml:2:67: error: '/faults/0/channels': expected all, gyro, accel, angle or rate, "
             "found 'gyr'; did you mean 'gyro'?"},
        Case{"OfAFaultWithoutChannels",
             "faults:\n  - {sensor: imu, kind: dropout, at_s: 1, channels: gyro}\n",
             "sc.yaml:2:43: error: key 'channels' in '/faults/0' belongs to kind 'bias_step', "
             "'scale_step', 'saturation', 'outlier_burst', 'nan_burst', not to 'dropout'"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Legs, WrongText,
    testing::Values(
        Case{"GaitWithoutStance", "robot: mini_cheetah\ncontrol: {gait: {duty: 0}}\n",
             "sc.yaml:2:24: error: '/control/gait/duty': expected a finite number from 0.1 to "
             "0.95, found "
             "'0'"},
        Case{
            "MissingFoot",
            "robot: mini_cheetah\ndrive: {feet: [FR_foot, FL_foot, RR_foot, RL_fot]}\n",
            "sc.yaml:2:15: error: '/drive/feet': there is no link in the URDF called 'RL_fot'; did "
            "you mean 'RL_foot'?"},
        Case{"GaitOfThreeFeet", "robot: mini_cheetah\ncontrol: {gait: {offsets: [0, 0.5, 0]}}\n",
             "sc.yaml:2:17: error: '/control/gait': control/gait: offsets has 3 entries, expected "
             "one a foot, 4"},
        Case{"WheelsOfAWalker", "robot: mini_cheetah\nactual: {track_scale: 1.1}\n",
             "sc.yaml:2:23: error: '/actual/track_scale': expected nothing: this robot has no "
             "wheels, found '1.1'"},
        Case{"ControlOfWheels", "robot: husky\ncontrol: {in_air: true}\n",
             "sc.yaml:2:10: error: '/control': this robot has no legs to walk on"},
        Case{"StairsForWheels", "robot: husky\nworld:\n  terrain: {kind: stairs}\n",
             "sc.yaml:3:19: error: '/world/terrain/kind': expected ground for a robot without "
             "legs, found 'stairs'"}),
    [](const auto& test) { return test.param.name; });

TEST(ScenarioError, ChannelsThatTheSensorHasAreRead) {
  const auto channels = [](const std::string& sensor, const std::string& word) {
    const std::string fault = "{sensor: " + sensor + ", kind: bias_step, at_s: 1, offset: 1" + word;
    return ReadScenarioText("faults: [" + fault + "}]\n", "sc.yaml", {}).faults.at(0).channels;
  };
  EXPECT_EQ(channels("imu", ""), sim::FaultChannels::kAll);
  EXPECT_EQ(channels("imu", ", channels: gyro"), sim::FaultChannels::kGyro);
  EXPECT_EQ(channels("imu", ", channels: accel"), sim::FaultChannels::kAccel);
  EXPECT_EQ(channels("wheels", ", channels: angle"), sim::FaultChannels::kAngle);
  EXPECT_EQ(channels("wheels", ", channels: rate"), sim::FaultChannels::kRate);
}

TEST(ScenarioError, ReportsSeveralAtOnce) {
  EXPECT_EQ(MessageOf("sede: 1\nduration_s: -1\nmotion: {path: sqare}\n"),
            "sc.yaml:2:13: error: '/duration_s': expected a finite number above 0 and at most "
            "100000, found '-1'\n"
            "sc.yaml:3:16: error: '/motion/path': expected stand, square, circle, figure_eight, "
            "waypoints or velocity_profile, found 'sqare'; did you mean 'square'?\n"
            "sc.yaml:1:1: error: unknown key 'sede' in '/'; did you mean 'seed'?");
}

TEST(ScenarioError, NamesTheOverride) {
  EXPECT_EQ(MessageOf("seed: 1\n", {"seed=x"}),
            "--set seed=x: error: '/seed': expected a whole number of at least 0, found 'x'");
  EXPECT_EQ(MessageOf("seed: 1\n", {"sensors.imu.rate_hz=300"}),
            "--set sensors.imu.rate_hz=300: error: '/sensors/imu/rate_hz': expected an integer "
            "fraction of the physics rate of 1000 Hz, found 300; the nearest is 333.3333333333333");
  EXPECT_EQ(MessageOf("seed: 1\n", {"seed"}),
            "--set seed: error: expected KEY=VALUE, such as seed=2");
  EXPECT_EQ(MessageOf("seed: 1\n", {"=1"}), "--set =1: error: the key has an empty part");
  EXPECT_EQ(MessageOf("seed: 1\n", {"a..b=1"}), "--set a..b=1: error: the key has an empty part");
  EXPECT_EQ(MessageOf("faults: []\n", {"faults.0.at_s=1"}),
            "--set faults.0.at_s=1: error: '0' is no index of a list of 0");
  EXPECT_EQ(MessageOf("seed: 1\n", {"include=x.yaml"}),
            "--set include=x.yaml: error: '/include': only a file can include files");
}

TEST(ScenarioError, RefusesDeepAndHugeTrees) {
  std::string deep = "description: ";
  for (int i = 0; i < 100; ++i) deep += '[';
  for (int i = 0; i < 100; ++i) deep += ']';
  EXPECT_NE(MessageOf(deep).find("more than 64 levels deep"), std::string::npos);
  // Each anchor holds ten of the one before: ten lines are 10^10 values.
  std::string wide = "a0: &a0 [x]\n";
  for (int i = 1; i <= 10; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    wide += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 10; ++j) wide += (j == 0 ? "" : ", ") + last;
    wide += "]\n";
  }
  EXPECT_NE(MessageOf(wide).find("more than 100000 values"), std::string::npos);
}

TEST(ScenarioError, RefusesFilesThatAreNone) {
  const auto message = [](const std::string& path) {
    try {
      ReadScenario(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message("no/such.yaml"), "no/such.yaml: error: there is no such file");
  const auto folder = std::filesystem::path(testing::TempDir());
  EXPECT_EQ(message(folder.string()), folder.string() + ": error: is a folder, expected a file");
  const std::string huge = (folder / "huge.yaml").string();
  std::ofstream(huge) << "# " << std::string(1'100'000, 'x') << "\n";
  EXPECT_EQ(message(huge), huge + ": error: is larger than 1 MB, which no scenario is");
}

TEST(ScenarioError, RefusesIncludesInACircle) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "circle";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.yaml") << "include: b.yaml\n";
  std::ofstream(folder / "b.yaml") << "seed: 2\ninclude: [a.yaml]\n";
  try {
    ReadScenario((folder / "a.yaml").string());
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder / "b.yaml").string() +
                  ":2:11: error: '/include': 'a.yaml' includes itself in the end");
  }
}

}  // namespace
}  // namespace reckon::harness
