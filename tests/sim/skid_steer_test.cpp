#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "reckon/sim/skid_steer.h"
#include "reckon/sim/skid_steer_drive.h"
#include "sim/husky.h"

namespace reckon::sim {
namespace {

constexpr double kDt = 0.001;

/// Four wheels in the air, driven by the motors.
struct Bench {
  SkidSteerDrive drive{Husky().skid_steer()};
  models::EncoderVector angle = models::EncoderVector::Zero(4),
                        rate = models::EncoderVector::Zero(4);
  models::EncoderVector inertia = models::EncoderVector::Constant(4, 0.104);  // wheel + armature
  models::EncoderVector load = models::EncoderVector::Zero(4);
  double largest_torque = 0.0;

  void Run(const DriveCommand& command, double for_s) {
    for (int i = 0; i < std::lround(for_s / kDt); ++i) {
      const models::EncoderVector torque = drive.Update(command, angle, rate, kDt);
      largest_torque = std::max(largest_torque, torque.cwiseAbs().maxCoeff());
      rate += (torque + load).cwiseQuotient(inertia) * kDt;
      angle += rate * kDt;
    }
  }
};

TEST(SkidSteerDrive, ReachesTheWheelSpeedsOfTheCommand) {
  Bench bench;
  bench.Run({0.8, 0.5}, 5.0);
  const double radius = 0.1651, half_track = 0.555 / 2;
  for (const int left : {0, 1})
    EXPECT_NEAR(bench.rate(left), (0.8 - 0.5 * half_track) / radius, 1e-6);
  for (const int right : {2, 3})
    EXPECT_NEAR(bench.rate(right), (0.8 + 0.5 * half_track) / radius, 1e-6);
}

TEST(SkidSteerDrive, RampsTheCommand) {
  Bench bench;
  bench.Run({10.0, 0.0}, 0.5);
  // 1 m/s² for 0.5 s; the loop lags a ramp by less than a tenth of a second.
  EXPECT_NEAR(bench.rate.mean() * 0.1651, 0.5, 0.1);
  EXPECT_LT(bench.rate.mean() * 0.1651, 0.5 + 1e-3);
}

TEST(SkidSteerDrive, LimitsTheTorqueWithoutWindup) {
  Bench bench;
  bench.load.setConstant(
      -200.0);  // far beyond the motor's 40 N m: the wheels are dragged backwards
  bench.inertia.setConstant(100.0);
  bench.Run({0.8, 0.0}, 20.0);
  // Motor at its limit, damping of 0.1 N m s on top (the wheels turn at −30 rad/s).
  EXPECT_LT(bench.largest_torque, 40.0 + 0.1 * bench.rate.cwiseAbs().maxCoeff() + 1e-9);
  bench.load.setZero();
  bench.rate.setZero();
  bench.inertia.setConstant(0.104);
  bench.Run({0.8, 0.0}, 0.5);
  // A wound-up integral (20 s of error) would drive the wheel far beyond its target of 4.8 rad/s.
  EXPECT_LT(bench.rate.maxCoeff(), 1.5 * 0.8 / 0.1651);
}

TEST(SkidSteerDrive, ABeltKeepsTheWheelsOfASideTogether) {
  Bench bench;
  bench.load << 10.0, -10.0, 0.0, 0.0;  // the ground pushes the front wheel and holds the rear one
  bench.Run({0.8, 0.0}, 5.0);
  EXPECT_NEAR(bench.rate(0), bench.rate(1), 1e-3);
  EXPECT_NEAR(bench.angle(0) - bench.angle(1), 2 * 10.0 / 2500.0,
              1e-4);  // torque / stiffness, twice
  EXPECT_NEAR(bench.rate.head(2).mean(), 0.8 / 0.1651, 1e-3);
}

TEST(SkidSteerDrive, TheBrakeHoldsAndLetsGoWithoutABump) {
  Bench bench;
  bench.load.setConstant(13.0);  // a 35° slope
  bench.drive.SetBrake(true);
  bench.Run({}, 2.0);
  const double held = bench.angle.mean();
  EXPECT_LT(std::abs(held), 13.0 / 2000.0 * 1.01);  // torque over the brake's stiffness
  bench.drive.SetBrake(false);
  bench.Run({}, 2.0);
  EXPECT_NEAR(bench.angle.mean(), held, 1e-9);
}

std::string Refusal(const std::function<void(RobotConfig&, ActualConfig&)>& edit) {
  RobotConfig robot = Husky();
  ActualConfig actual;
  edit(robot, actual);
  try {
    SkidSteer::Check(robot, actual, models::UrdfRobot::FromFile(robot.urdf_path));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SkidSteer, RefusesARobotThatCannotBeBuilt) {
  using testing::AssertionFailure;
  const auto says = [](const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos ? testing::AssertionSuccess()
                                                   : AssertionFailure() << "'" << message << "'";
  };
  EXPECT_EQ(Refusal([](auto&, auto&) {}), "");
  EXPECT_TRUE(
      says(Refusal([](auto& r, auto&) { r.skid_steer().wheel_radius_m = -1; }), "wheel_radius_m"));
  EXPECT_TRUE(says(Refusal([](auto& r, auto&) { r.skid_steer().wheel_armature_kg_m2 = NAN; }),
                   "wheel_armature"));
  EXPECT_TRUE(
      says(Refusal([](auto& r, auto&) { r.skid_steer().left_joints.clear(); }), "left_joints"));
  EXPECT_TRUE(says(Refusal([](auto& r, auto&) { r.skid_steer().left_joints = {"mid_wheel"}; }),
                   "'mid_wheel'"));
  EXPECT_TRUE(says(Refusal([](auto& r, auto&) { r.skid_steer().left_joints = {"imu_joint"}; }),
                   "wheel 'imu_joint' is not a continuous joint"));
  EXPECT_TRUE(says(Refusal([](auto& r, auto&) { r.base_link = "chassis"; }), "'chassis'"));
  EXPECT_TRUE(says(Refusal([](auto&, auto& a) { a.track_scale = 0; }), "actual.track_scale"));
  EXPECT_TRUE(says(Refusal([](auto&, auto& a) { a.wheel_radius_scale[1] = -1; }),
                   "actual.wheel_radius_scale"));
}

}  // namespace
}  // namespace reckon::sim
