// Depth and pose sensors, and what filters can be told beside noise and gates: from a scenario's
// text to the filters.

#include <gtest/gtest.h>

#include "harness/run_case.h"
#include "reckon/harness/beliefs.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/yaml_writer.h"

namespace reckon::harness {
namespace {

using testing::MeasurementStreams;
using testing::RunIn;
using testing::TemporaryFolder;

constexpr const char* kText = R"(
duration_s: 2
sensors:
  imu_2: {type: imu, frame: velocity_link, grade: vn100}
  depth: {type: depth, frame: velocity_link, rate_hz: 5, noise_m: 0.3, offset_m: 0.1,
          resolution_m: 0.01, latency_s: 0.05}
  gps: {type: pose, frame: velocity_link, rate_hz: 4, noise_position_m: [0.1, 0.2, 0.3],
        noise_orientation_rad: [0.01, 0.02, 0.03]}
  beacon: {type: pose, frame: base_link, orientation: false}
nominal: {noise: {depth_m: 0.4, pose_scale: 2, standstill_m_per_s: 0.01, floor_height_m: 0.05,
                  wheel_yaw_rate_rad_per_s: 0.2}}
estimators:
  all: {type: iterated_inekf, iterations: 3, history_s: 1.25, standstill: {use: true, window_s: 0.75},
        floor: {use: true, height_m: 0.13}, gyro_filter: {source: wheels},
        initialisation: {kind: pose}}
  plain: {type: mekf, noise: matched, gyro_filter: {source: imu_2}}
)";

Scenario Read(const std::string& text) { return ReadScenarioText(text, "sc.yaml", {}); }

std::string MessageOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void ExpectValues(const Scenario& s) {
  const auto& depth = std::get<sim::DepthConfig>(s.sensors.at("depth").errors);
  EXPECT_EQ(depth.timing.rate_hz, 5.0);
  EXPECT_EQ(depth.timing.latency_s, 0.05);
  EXPECT_EQ(depth.noise_m, 0.3);
  EXPECT_EQ(depth.offset_m, 0.1);
  EXPECT_EQ(depth.resolution_m, 0.01);
  const auto& gps = std::get<sim::PoseConfig>(s.sensors.at("gps").errors);
  EXPECT_EQ(gps.noise_position_m, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(gps.noise_orientation_rad, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_TRUE(gps.orientation);
  EXPECT_FALSE(std::get<sim::PoseConfig>(s.sensors.at("beacon").errors).orientation);
  const EstimatorConfig& all = s.estimators.at("all");
  EXPECT_EQ(all.iterations, 3);
  EXPECT_EQ(all.history_s, 1.25);
  EXPECT_TRUE(all.standstill.use);
  EXPECT_EQ(all.standstill.window_s, 0.75);
  EXPECT_TRUE(all.floor.use);
  EXPECT_EQ(all.floor.height_m, 0.13);
  EXPECT_EQ(all.gyro_filter.source, "wheels");
  EXPECT_EQ(all.initialisation.kind, estimator::InitialisationKind::kPose);
  EXPECT_EQ(all.noise.depth_m, 0.4);
  EXPECT_EQ(all.noise.pose_scale, 2.0);
  const EstimatorConfig& plain = s.estimators.at("plain");
  EXPECT_EQ(plain.history_s, 0.5);
  EXPECT_FALSE(plain.standstill.use || plain.floor.use);
}

TEST(AidingScenario, IsReadAndWrittenAsItIs) {
  const Scenario s = Read(kText);
  ExpectValues(s);
  const std::string once = WriteScenario(s);
  ExpectValues(Read(once));
  EXPECT_EQ(WriteScenario(Read(once)), once);
}

TEST(AidingScenario, MatchedNoiseTakesADepthSensorsWhiteNoise) {
  // 0.3 and a quantiser of 0.4 (resolution² / 12 = 0.16): a 3-4-5 triangle. The offset is not
  // white.
  const Scenario s = Read(
      "sensors: {d: {type: depth, frame: base_link, noise_m: 0.3, offset_m: 9,\n"
      "  resolution_m: 1.3856406460551018}}\n"
      "nominal: {noise: {pose_scale: 3}}\n"
      "estimators: {a: {noise: matched}}\n");
  EXPECT_NEAR(s.estimators.at("a").noise.depth_m, 0.5, 1e-15);
  EXPECT_EQ(s.estimators.at("a").noise.pose_scale, 1.0);
}

TEST(AidingScenario, FiltersAreToldWhatIsWritten) {
  const Scenario s = Read(kText);
  const models::Suite nominal = LoadRobot(s).nominal;
  EXPECT_EQ(nominal.sensors[*nominal.Find("depth")].kind, models::SensorKind::kDepth);
  EXPECT_EQ(nominal.sensors[*nominal.Find("gps")].kind, models::SensorKind::kPose);
  EXPECT_EQ(nominal.sensors[*nominal.Find("gps")].period_ns, 250'000'000);
  const estimator::Setup setup = MakeSetup(s.estimators.at("all"), s.initial, nominal, 9.81);
  EXPECT_EQ(setup.iterations, 3);
  EXPECT_EQ(setup.history_s, 1.25);
  EXPECT_TRUE(setup.standstill.use);
  EXPECT_EQ(setup.standstill.window_s, 0.75);
  EXPECT_TRUE(setup.floor.use);
  EXPECT_EQ(setup.floor.height_m, 0.13);
  EXPECT_EQ(setup.gyro_filter.source, "wheels");
  EXPECT_EQ(setup.initialisation.kind, estimator::InitialisationKind::kPose);
  EXPECT_EQ(setup.noise.wheel_yaw_rate_rad_per_s, 0.2);
}

TEST(AidingScenario, RunsAndFiltersUseTheNewSensors) {
  const TemporaryFolder folder;
  const auto recording = RunIn(folder / "a", Read(kText), "aiding") / "recording.h5";
  const auto streams = MeasurementStreams(recording);
  EXPECT_EQ(streams.at("depth").size(), 9U);  // the tenth is on its way
  EXPECT_EQ(streams.at("gps").size(), 8U);
  EXPECT_EQ(streams.at("beacon").size(), 20U);
  const ground_truth::RecordingReader reader(recording);
  for (std::size_t i = 0; i < 2; ++i) {
    std::map<std::string, int> corrections;
    auto cursor = reader.ReadCorrections(i);
    while (const auto row = cursor.Next()) ++corrections[reader.sensors()[row->sensor].name];
    EXPECT_GT(corrections["depth"], 5) << i;
    EXPECT_GT(corrections["gps"], 5) << i;
    EXPECT_GT(corrections["beacon"], 5) << i;
  }
}

struct Case {
  const char* name;
  const char* text;
  const char* message;
};

class WrongAiding : public ::testing::TestWithParam<Case> {};

TEST_P(WrongAiding, IsExplained) { EXPECT_EQ(MessageOf(GetParam().text), GetParam().message); }

constexpr const char* kFine = "no error";

INSTANTIATE_TEST_SUITE_P(
    Scenario, WrongAiding,
    ::testing::Values(
        Case{"ToesAreNotSimulated", "sensors: {feet: {type: toes, frame: base_link}}\n",
             "sc.yaml:1:24: error: '/sensors/feet/type': expected imu, encoders, body_velocity, "
             "depth, pose, dvl, contacts, torques or foot_forces, found 'toes'"},
        Case{"ContactsOfARobotWithoutFeet", "sensors: {feet: {type: contacts, frame: base_link}}\n",
             "sc.yaml:1:24: error: '/sensors/feet/type': expected no contacts, foot forces or "
             "torques: this robot has no legs, found 'contacts'"},
        Case{"NegativeDepthNoise", "sensors: {d: {type: depth, frame: base_link, noise_m: -1}}\n",
             "sc.yaml:1:55: error: '/sensors/d/noise_m': expected a finite number from 0 to 100, "
             "found '-1'"},
        Case{"PoseWithoutPoseSensor", "estimators: {a: {initialisation: {kind: pose}}}\n",
             "sc.yaml:1:41: error: '/estimators/a/initialisation/kind': 'pose' needs a pose "
             "sensor that knows its orientation, and is given none"},
        Case{"PoseSensorThatIsNotGiven",
             "sensors: {gps: {type: pose, frame: base_link}}\n"
             "estimators: {a: {sensors: [imu], initialisation: {kind: pose}}}\n",
             "sc.yaml:2:57: error: '/estimators/a/initialisation/kind': 'pose' needs a pose "
             "sensor that knows its orientation, and is given none"},
        Case{"PoseSensorThatIsGiven",
             "sensors: {gps: {type: pose, frame: base_link}}\n"
             "estimators: {a: {sensors: [imu, gps], initialisation: {kind: pose}}}\n",
             kFine},
        Case{"PoseSensorWithoutOrientation",
             "sensors: {gps: {type: pose, frame: base_link, orientation: false}}\n"
             "estimators: {a: {initialisation: {kind: pose}}}\n",
             "sc.yaml:2:41: error: '/estimators/a/initialisation/kind': 'pose' needs a pose "
             "sensor that knows its orientation, and is given none"},
        Case{"EverythingOfAProcess",
             "estimators: {a: {type: process, command: [a], gate: {action: \"off\"}, iterations: "
             "3,\n"
             " standstill: {use: true}, initialisation: {kind: static}}}\n",
             kFine},
        Case{"IterationsOfAnother", "estimators: {a: {type: inekf, iterations: 3}}\n",
             "sc.yaml:1:31: error: key 'iterations' in '/estimators/a' belongs to type "
             "'iterated_inekf', 'process', not to 'inekf'"},
        Case{"TooManyIterations", "estimators: {a: {type: iterated_inekf, iterations: 21}}\n",
             "sc.yaml:1:52: error: '/estimators/a/iterations': expected a whole number from 1 to "
             "20, found '21'"},
        Case{"TooLongAHistory", "estimators: {a: {history_s: 10.5}}\n",
             "sc.yaml:1:29: error: '/estimators/a/history_s': expected a finite number from 0 to "
             "10, found '10.5'"},
        Case{"HistoryOfOdometry", "estimators: {a: {type: odometry, history_s: 1}}\n",
             "sc.yaml:1:34: error: key 'history_s' in '/estimators/a' belongs to type 'inekf', "
             "'iterated_inekf', 'mekf', 'process', not to 'odometry'"},
        Case{"NoWindow", "estimators: {a: {standstill: {window_s: 0}}}\n",
             "sc.yaml:1:41: error: '/estimators/a/standstill/window_s': expected a finite number "
             "above 0 and at most 60, found '0'"},
        Case{"StandstillWithoutNoise",
             "nominal: {noise: {standstill_m_per_s: 0}}\n"
             "estimators: {a: {standstill: {use: true}}}\n",
             "sc.yaml:2:36: error: '/estimators/a/standstill/use': expected a positive noise "
             "standstill_m_per_s beside it, found 'true'"},
        Case{"FloorWithoutNoise",
             "nominal: {noise: {floor_height_m: 0}}\n"
             "estimators: {a: {floor: {use: true}}}\n",
             "sc.yaml:2:31: error: '/estimators/a/floor/use': expected a positive noise "
             "floor_height_m beside it, found 'true'"},
        Case{"DepthWithoutNoise",
             "sensors: {d: {type: depth, frame: base_link}}\n"
             "estimators: {a: {noise: {depth_m: 0}}}\n",
             "sc.yaml:2:25: error: '/estimators/a/noise': expected a positive depth_m: the "
             "estimator is given a depth sensor, found a map"},
        Case{"DepthThatIsNotGiven",
             "sensors: {d: {type: depth, frame: base_link}}\n"
             "estimators: {a: {sensors: [imu, wheels], noise: {depth_m: 0}}}\n",
             kFine},
        Case{"SourceThatIsNone", "estimators: {a: {gyro_filter: {source: whels}}}\n",
             "sc.yaml:1:40: error: '/estimators/a/gyro_filter/source': there is no sensor 'whels'; "
             "did you mean 'wheels'?"},
        Case{"SourceOfAnotherType",
             "sensors: {v: {type: body_velocity, frame: base_link}}\n"
             "estimators: {a: {gyro_filter: {source: v}}}\n",
             "sc.yaml:2:40: error: '/estimators/a/gyro_filter/source': expected an IMU or the "
             "wheels' encoders, found 'v'"},
        Case{"SourceThatIsTheImuItself", "estimators: {a: {gyro_filter: {source: imu}}}\n",
             "sc.yaml:1:40: error: '/estimators/a/gyro_filter/source': expected another IMU than "
             "the one that it refines, found 'imu'"},
        Case{"SourceThatIsNotGiven",
             "nominal: {noise: {wheel_yaw_rate_rad_per_s: 0.1}}\n"
             "estimators: {a: {sensors: [imu], gyro_filter: {source: wheels}}}\n",
             "sc.yaml:2:56: error: '/estimators/a/gyro_filter/source': expected a sensor that the "
             "estimator is given, found 'wheels'"},
        Case{"SourceWithoutNoise",
             "nominal: {noise: {wheel_yaw_rate_rad_per_s: 0}}\n"
             "estimators: {a: {gyro_filter: {source: wheels}}}\n",
             "sc.yaml:2:40: error: '/estimators/a/gyro_filter/source': expected a positive noise "
             "wheel_yaw_rate_rad_per_s beside wheels, found 'wheels'"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace reckon::harness
