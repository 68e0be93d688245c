#include "reckon/sim/driver.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

/// A base that does what it is told, with the driver at the wheel.
struct Unicycle {
  explicit Unicycle(const MotionConfig& motion) : driver(motion) {}

  Driver driver;
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  double yaw = 0.0, t = 0.0, distance = 0.0;
  DriveCommand command;

  void Step() {
    const double dt = 1.0 / Driver::kRateHz;
    command = driver.Update(t, p, yaw);
    p += command.speed_m_s * dt * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    yaw += command.yaw_rate_rad_s * dt;
    distance += command.speed_m_s * dt;
    t += dt;
  }
  void Run(double until_s) {
    while (t < until_s) Step();
  }
};

MotionConfig Motion(PathKind path) {
  MotionConfig motion;
  motion.path = path;
  return motion;
}

TEST(Driver, StandsStill) {
  Unicycle robot(Motion(PathKind::kStand));
  robot.Run(20);
  EXPECT_EQ(robot.p, Eigen::Vector2d::Zero());
}

TEST(Driver, WaitsForTheStart) {
  MotionConfig motion = Motion(PathKind::kSquare);
  motion.start_s = 3.0;
  Driver driver(motion);
  EXPECT_EQ(driver.Update(2.99, {0, 0}, 0).speed_m_s, 0.0);
  EXPECT_EQ(driver.Update(3.0, {0, 0}, 0).speed_m_s, 0.8);
}

TEST(Driver, FollowsACircle) {
  MotionConfig motion = Motion(PathKind::kCircle);
  motion.radius_m = 5.0;
  Unicycle robot(motion);
  robot.Run(15);
  for (int i = 0; i < 3000; ++i) {
    robot.Step();
    // Steady state: the gain of 1.5/s needs a heading error of ω/1.5 = 0.8/5/1.5 = 0.107 towards a
    // point 1 m ahead, whose chord takes 0.1 of it: the radius is right within a few centimetres.
    ASSERT_NEAR((robot.p - Eigen::Vector2d(0, 5)).norm(), 5.0, 0.05);
  }
}

TEST(Driver, SteersWithClampedProportionalControl) {
  Driver driver(Motion(PathKind::kSquare));  // the target is 1 m ahead on the x axis
  const auto slight = driver.Update(1.0, {0, 0}, 0.1);
  EXPECT_NEAR(slight.yaw_rate_rad_s, -0.15, 1e-12);
  EXPECT_NEAR(slight.speed_m_s, 0.8 * std::cos(0.1), 1e-12);
  const auto away = driver.Update(1.0, {0, 0}, 3.0);
  EXPECT_EQ(away.yaw_rate_rad_s, -1.0);
  EXPECT_NEAR(away.speed_m_s, 0.8 * 0.2, 1e-12);
}

TEST(Driver, StopsAfterItsLaps) {
  for (const auto path : {PathKind::kSquare, PathKind::kFigureEight}) {
    MotionConfig motion = Motion(path);
    motion.side_m = 5.0;
    motion.radius_m = 2.0;
    motion.laps = 2.0;
    Unicycle robot(motion);
    robot.Run(150);
    EXPECT_EQ(robot.command.speed_m_s, 0.0);
    // Both end where they began, up to what a look-ahead of 1 m cuts off a corner.
    EXPECT_LT(robot.p.norm(), 0.7);
    const double way = path == PathKind::kSquare ? 40.0 : 16 * std::numbers::pi;
    EXPECT_NEAR(robot.distance, way, 0.12 * way);
  }
}

TEST(Driver, StopsAtTheLastWaypoint) {
  MotionConfig motion = Motion(PathKind::kWaypoints);
  motion.waypoints_m = {{4, 0}, {4, 4}};
  Unicycle robot(motion);
  robot.Run(60);
  EXPECT_EQ(robot.command.speed_m_s, 0.0);
  EXPECT_LT((robot.p - Eigen::Vector2d(4, 4)).norm(), 0.1);
}

TEST(Driver, HoldsTheRowsOfAProfile) {
  MotionConfig motion = Motion(PathKind::kVelocityProfile);
  motion.start_s = 0.5;
  motion.profile = {{0.0, 0.1, 0.2}, {2.0, -0.3, 0.0}};
  Driver driver(motion);
  EXPECT_EQ(driver.Update(0.4, {0, 0}, 0).speed_m_s, 0.0);
  EXPECT_EQ(driver.Update(1.9, {0, 0}, 0).yaw_rate_rad_s, 0.2);
  EXPECT_EQ(driver.Update(2.0, {0, 0}, 0).speed_m_s, -0.3);
  EXPECT_EQ(driver.Update(99.0, {0, 0}, 0).speed_m_s, -0.3);
}

TEST(Driver, PausesAfterEachTimeOfGoing) {
  MotionConfig motion = Motion(PathKind::kVelocityProfile);
  motion.start_s = 1.0;
  motion.go_s = 4.0;
  motion.stop_s = 2.0;
  motion.profile = {{0.0, 0.5, 0.0}};
  Driver driver(motion);
  EXPECT_EQ(driver.Update(4.9, {0, 0}, 0).speed_m_s, 0.5);
  EXPECT_EQ(driver.Update(5.1, {0, 0}, 0).speed_m_s, 0.0);
  EXPECT_EQ(driver.Update(6.9, {0, 0}, 0).speed_m_s, 0.0);
  EXPECT_EQ(driver.Update(7.1, {0, 0}, 0).speed_m_s, 0.5);
}

TEST(Driver, RefusesWhatCannotBeDriven) {
  const auto refuses = [](PathKind path, const std::function<void(MotionConfig&)>& edit,
                          const std::string& key) {
    MotionConfig motion = Motion(path);
    edit(motion);
    try {
      const Driver driver(motion);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find(key) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refuses(
      PathKind::kSquare, [](auto& m) { m.side_m = -1; }, "side_m"));
  EXPECT_TRUE(refuses(
      PathKind::kSquare, [](auto& m) { m.speed_m_s = 0; }, "speed_m_s"));
  EXPECT_TRUE(refuses(
      PathKind::kCircle, [](auto& m) { m.laps = -1; }, "laps"));
  EXPECT_TRUE(refuses(
      PathKind::kCircle, [](auto& m) { m.radius_m = NAN; }, "radius_m"));
  EXPECT_TRUE(refuses(
      PathKind::kStand, [](auto& m) { m.start_s = -1; }, "start_s"));
  EXPECT_TRUE(refuses(
      PathKind::kWaypoints, [](auto&) {}, "waypoints_m"));
  EXPECT_TRUE(refuses(
      PathKind::kVelocityProfile, [](auto&) {}, "profile"));
  EXPECT_TRUE(refuses(
      PathKind::kVelocityProfile,
      [](auto& m) {
        m.profile = {{2, 0, 0}, {1, 0, 0}};
      },
      "profile"));
}

}  // namespace
}  // namespace reckon::sim
