// Scenarios of underwater vehicles: what they resolve to, and what a wrong one is answered with.

#include <gtest/gtest.h>

#include "harness/seeds.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/harness/yaml_writer.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::harness {
namespace {

Scenario Read(const std::string& text) { return ReadScenarioText(text, "sc.yaml"); }

std::string MessageOf(const std::string& text) {
  try {
    (void)Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const sim::UnderwaterConfig& DriveOf(const Scenario& scenario) {
  return std::get<sim::UnderwaterConfig>(scenario.drive);
}

TEST(AuvScenario, TakesTheRobotsOwnNumbers) {
  const Scenario scenario = Read("robot: bluerov2\n");
  EXPECT_EQ(DriveOf(scenario).thrusters.size(), 8U);
  EXPECT_EQ(DriveOf(scenario).hydrodynamics.volume_m3, 0.0134);
  EXPECT_EQ(DriveOf(scenario).hydrodynamics.added_mass(2, 2), 18.68);
  const auto& dvl = std::get<sim::DvlConfig>(scenario.sensors.at("dvl").errors);
  EXPECT_EQ(dvl.beam_angle_deg, 22.5) << "its grade's";
  EXPECT_EQ(dvl.rate_by_altitude.size(), 5U);
  ASSERT_TRUE(scenario.world.water) << "the sea is there without a word";
  EXPECT_EQ(scenario.world.water->density_kg_m3, 1025.0);
  const Robot robot = LoadRobot(scenario);
  const auto dvl_id = robot.nominal.Find("dvl");
  ASSERT_TRUE(dvl_id);
  EXPECT_EQ(robot.nominal.sensors[*dvl_id].kind, models::SensorKind::kBodyVelocity);
  EXPECT_EQ(robot.nominal.sensors[*dvl_id].X_BS.p, Eigen::Vector3d(-0.12, 0.03, -0.11));
  EXPECT_TRUE(robot.joints.empty());
}

TEST(AuvScenario, WhatIsWrittenWinsOverTheGrade) {
  const Scenario scenario =
      Read("robot: bluerov2\nsensors: {dvl: {grade: explorer, noise_m_per_s: 0.1}}\n");
  const auto& dvl = std::get<sim::DvlConfig>(scenario.sensors.at("dvl").errors);
  EXPECT_EQ(dvl.noise_m_per_s, 0.1);
  EXPECT_EQ(dvl.altitude_max_m, 81.0);
}

TEST(AuvScenario, ResolvesToTheSameScenario) {
  for (const char* robot : {"bluerov2", "girona500"}) {
    const std::string first = WriteScenario(Read(std::string("robot: ") + robot + "\n"));
    EXPECT_EQ(WriteScenario(Read(first)), first) << robot;
    EXPECT_NE(first.find("mission:"), std::string::npos);
    EXPECT_EQ(first.find("motion:"), std::string::npos);
  }
}

TEST(AuvScenario, AResultOfBeforeThereWereOtherDrivesIsAHusky) {
  const Scenario scenario = Read("robot: husky\ndrive: {torque_limit_n_m: 30}\n");
  EXPECT_EQ(std::get<sim::SkidSteerConfig>(scenario.drive).torque_limit_n_m, 30.0);
}

/// Mass and volume of the vehicles: how much more water they displace than they weigh.
double SpareBuoyancy(const std::string& name) {
  const Robot robot = LoadRobot(Read("robot: " + name + "\n"));
  const auto urdf = models::UrdfRobot::FromFile(robot.simulated.urdf_path);
  const auto& drive = std::get<sim::UnderwaterConfig>(robot.simulated.drive);
  return 1025.0 * drive.hydrodynamics.volume_m3 / urdf.TotalMass() - 1.0;
}

TEST(AuvScenario, VehiclesFloatIfNothingPushes) {
  EXPECT_NEAR(SpareBuoyancy("bluerov2"), 0.0174, 1e-3);  // 2.3 N of 132
  EXPECT_NEAR(SpareBuoyancy("girona500"), 0.005, 1e-3);
}

struct Case {
  const char* name;
  const char* text;
  const char* message;
};

class WrongAuv : public testing::TestWithParam<Case> {};

TEST_P(WrongAuv, IsExplained) { EXPECT_EQ(MessageOf(GetParam().text), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    Scenario, WrongAuv,
    testing::Values(
        Case{"MotionOfWheels", "robot: bluerov2\nmotion: {path: square}\n",
             "sc.yaml:2:9: error: '/motion': this robot swims: its `mission:` says where it goes"},
        Case{
            "MissionOfWheels", "robot: husky\nmission: {kind: hover}\n",
            "sc.yaml:2:10: error: '/mission': this robot drives: its `motion:` says where it goes"},
        Case{
            "UnderTheSeabed", "robot: bluerov2\nworld: {water: {depth_m: 4}}\n",
            "sc.yaml:1:1: error: '/mission': it leads under the seabed: 4 m deep at x = 0 m, y = 0 "
            "m, where the bottom lies 4 m deep"},
        Case{"AboveTheSurface", "robot: bluerov2\nmission: {start_depth_m: -1}\n",
             "sc.yaml:2:10: error: '/mission': it leads above the surface: -1 m deep at x = 0 m, y "
             "= 0 m, where more than 0 m keep the vehicle under water"},
        Case{"NoBeamAngle", "robot: bluerov2\nsensors: {dvl: {beam_angle_deg: 0}}\n",
             "sc.yaml:2:33: error: '/sensors/dvl/beam_angle_deg': expected a finite number from 1 "
             "to 89, found '0'"},
        Case{"TwoBeams", "robot: bluerov2\nsensors: {dvl: {azimuths_deg: [0, 90]}}\n",
             "sc.yaml:2:31: error: '/sensors/dvl/azimuths_deg': beams: azimuths_deg must be 3 to 8 "
             "beams"},
        Case{"LogOnLand", "sensors: {dvl: {type: dvl, frame: base_link}}\n",
             "sc.yaml:1:23: error: '/sensors/dvl/type': a Doppler log needs a sea around it"},
        Case{"WaterOnLand", "world: {water: {depth_m: 4}}\n",
             "sc.yaml:1:16: error: '/world/water': expected no water: this robot drives on the "
             "ground, found a map"},
        Case{"WheelsUnderWater", "robot: bluerov2\nactual: {track_scale: 1.1}\n",
             "sc.yaml:2:23: error: '/actual/track_scale': expected nothing: this robot has no "
             "wheels, found '1.1'"},
        Case{"EncodersUnderWater",
             "robot: bluerov2\nsensors: {w: {type: encoders, frame: base_link}}\n",
             "sc.yaml:2:21: error: '/sensors/w/type': expected no encoders: this robot has no "
             "wheels, "
             "found 'encoders'"},
        Case{"KerbsUnderWater", "robot: bluerov2\nworld: {terrain: {kind: kerbs}}\n",
             "sc.yaml:2:25: error: '/world/terrain/kind': a seabed is flat, slope or rough"},
        Case{"NegativeMass", "robot: bluerov2\nactual: {mass_scale: -1}\n",
             "sc.yaml:2:22: error: '/actual/mass_scale': expected a finite number from 0.1 to 10, "
             "found '-1'"},
        Case{"FallingRates",
             "robot: bluerov2\nsensors: {dvl: {rate_by_altitude: [[5, 4], [3, 2]]}}\n",
             "sc.yaml:2:35: error: '/sensors/dvl/rate_by_altitude': expected altitudes that rise, "
             "found a list"}),
    [](const auto& c) { return std::string(c.param.name); });

/// `row` in place of the first of the BlueROV2's added mass.
std::string AddedMass(const std::string& row) {
  return "robot: bluerov2\ndrive:\n  hydrodynamics:\n    added_mass:\n      - " + row +
         "\n      - [0, 7, 0, 0, 0, 0]\n      - [0, 0, 18, 0, 0, 0]\n      - [0, 0, 0, 1, 0, 0]\n"
         "      - [0, 0, 0, 0, 1, 0]\n      - [0, 0, 0, 0, 0, 1]\n";
}

TEST(AuvScenario, RefusesAnAddedMassThatIsNone) {
  EXPECT_EQ(MessageOf(AddedMass("[6, 0, 0, 0, 0, 0]")), "no error");
  const auto names = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find("'/drive/hydrodynamics': hydrodynamics: added_mass"), std::string::npos)
        << text;
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  names(MessageOf(AddedMass("[6, 1, 0, 0, 0, 0]")), "symmetric");
  names(MessageOf(AddedMass("[-6, 0, 0, 0, 0, 0]")), "negative");
}

}  // namespace
}  // namespace reckon::harness
