#include "reckon/harness/robot_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

Robot Load(const std::string& text) { return LoadRobot(ReadScenarioText(text, "sc.yaml")); }

/// Fixed-axis roll, pitch, yaw, as a URDF writes them.
Eigen::Matrix3d FromRpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

constexpr double kRoundOff = 1e-14;

TEST(RobotFile, MountsSensorsWhereTheUrdfSays) {
  const Robot robot = Load("robot: husky\n");
  const auto imu = robot.nominal.Find("imu");
  ASSERT_TRUE(imu);
  const models::MountedSensor& sensor = robot.nominal.sensors[*imu];
  EXPECT_EQ(sensor.kind, models::SensorKind::kImu);
  EXPECT_EQ(sensor.period_ns, 5'000'000);
  // The figures of imu_joint in husky.urdf.
  EXPECT_TRUE(sensor.X_BS.p.isApprox(Eigen::Vector3d(0.19, 0, 0.149), kRoundOff));
  EXPECT_TRUE(sensor.X_BS.R.isApprox(FromRpy(3.1266, 0.0262, -0.0349), kRoundOff));
}

TEST(RobotFile, ActualAndNominalAreOneUntilAScenarioPartsThem) {
  const Robot robot = Load("robot: husky\n");
  ASSERT_EQ(robot.sensors.size(), robot.nominal.sensors.size());
  for (std::size_t i = 0; i < robot.sensors.size(); ++i) {
    EXPECT_EQ(robot.sensors[i].name, robot.nominal.sensors[i].name);
    EXPECT_EQ(robot.sensors[i].id, i);
    EXPECT_EQ(robot.sensors[i].X_BS.p, robot.nominal.sensors[i].X_BS.p);
    EXPECT_EQ(robot.sensors[i].X_BS.R, robot.nominal.sensors[i].X_BS.R);
  }
}

TEST(RobotFile, ActualMountingMovesTheImuAlone) {
  const Robot robot = Load(
      "actual: {imu_offset_m: [0.01, 0.02, 0.03], imu_rotation_deg: [0, 0, 90]}\n"
      "sensors: {velocity: {type: body_velocity, frame: velocity_link}}\n");
  const auto imu = *robot.nominal.Find("imu"), velocity = *robot.nominal.Find("velocity");
  const models::Pose& nominal = robot.nominal.sensors[imu].X_BS;
  const models::Pose& actual = robot.sensors[imu].X_BS;
  EXPECT_TRUE(actual.p.isApprox(nominal.p + Eigen::Vector3d(0.01, 0.02, 0.03), kRoundOff));
  // A quarter turn about the body's z takes the body's x to its y: rows move, not columns.
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(actual.R.isApprox(quarter * nominal.R, kRoundOff));
  EXPECT_EQ(robot.sensors[velocity].X_BS.R, robot.nominal.sensors[velocity].X_BS.R);
}

TEST(RobotFile, WheelsComeLeftThenRight) {
  const Robot robot = Load("nominal: {wheels: {origin_m: [0.1, 0, 0]}}\n");
  ASSERT_TRUE(robot.nominal.wheels);
  EXPECT_EQ(robot.joints, (std::vector<std::string>{"front_left_wheel", "rear_left_wheel",
                                                    "front_right_wheel", "rear_right_wheel"}));
  EXPECT_EQ(robot.nominal.wheels->left, (std::vector<int>{0, 1}));
  EXPECT_EQ(robot.nominal.wheels->right, (std::vector<int>{2, 3}));
  EXPECT_EQ(robot.nominal.wheels->X_BS.p, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(robot.nominal.wheels->encoders, "wheels");
  EXPECT_EQ(robot.simulated.skid_steer().left_joints.size(), 2U);
}

TEST(RobotFile, WithoutEncodersThereAreNoWheelsToBelieveIn) {
  const Robot robot = Load("sensors: {wheels: off}\n");
  EXPECT_FALSE(robot.nominal.wheels);
  EXPECT_FALSE(robot.nominal.Find("wheels"));
}

TEST(RobotFile, HuskysNumbersFitTogether) {
  const Robot robot = Load("robot: husky\n");
  const models::UrdfRobot urdf = models::UrdfRobot::FromFile(robot.simulated.urdf_path);
  const sim::SkidSteerConfig& drive = robot.simulated.skid_steer();
  // On flat ground the rolling radius is R − δ/3 with the tyre's deflection δ = m g / (4 k_n);
  // rough ground takes up to another percent of the distance. The nominal one lies between.
  const double deflection = urdf.TotalMass() * 9.81 / (4 * drive.normal_stiffness_n_m);
  const double flat = drive.wheel_radius_m - deflection / 3;
  EXPECT_LE(robot.nominal.wheels->rolling_radius_m, flat);
  EXPECT_GE(robot.nominal.wheels->rolling_radius_m, 0.99 * flat);
  // 1024 cycles a motor turn, gear 78.71, four counts a cycle; the vendor's 78 000 cycles a metre
  // are within half a percent.
  const auto& encoders =
      std::get<sim::EncoderConfig>(robot.sensors[*robot.nominal.Find("wheels")].errors);
  EXPECT_NEAR(encoders.counts_per_rad, 4 * 1024 * 78.71 / (2 * M_PI), 0.5);
  EXPECT_NEAR(encoders.counts_per_rad / 0.1651, 4 * 78000, 0.005 * 4 * 78000);
}

TEST(RobotFile, RefusesAnUnknownRobot) {
  Scenario scenario;
  scenario.robot = "huskie";
  EXPECT_THROW(LoadRobot(scenario), InputError);
}

}  // namespace
}  // namespace reckon::harness
