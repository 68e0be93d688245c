#include "reckon/sim/world.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "sim/husky.h"
#include "sim/message.h"

namespace reckon::sim {
namespace {

using testing_sim::Message;

WorldConfig Square(TerrainKind terrain) {
  WorldConfig config;
  config.terrain.kind = terrain;
  config.motion.path = PathKind::kSquare;
  config.motion.side_m = 3.0;
  config.motion.start_s = 0.1;
  return config;
}

/// What is compared bit for bit.
std::vector<double> Numbers(const World& world) {
  const auto truth = world.TruthNow();
  std::vector<double> numbers(truth.X_WB.p.begin(), truth.X_WB.p.end());
  numbers.insert(numbers.end(), truth.X_WB.R.data(), truth.X_WB.R.data() + 9);
  for (const auto& part : {truth.wheel_rate_rad_s, truth.wheel_slip_m_s, truth.wheel_load_n,
                           world.motion().joint_angle_rad}) {
    numbers.insert(numbers.end(), part.data(), part.data() + part.size());
  }
  return numbers;
}

void Append(std::vector<double>& all, const World& world) {
  const auto numbers = Numbers(world);
  all.insert(all.end(), numbers.begin(), numbers.end());
}

std::vector<double> Trace(const WorldConfig& config, std::uint64_t seed, int steps) {
  World world(Husky(), config, seed);
  std::vector<double> trace;
  for (int i = 0; i < steps; ++i) {
    world.Advance();
    Append(trace, world);
  }
  return trace;
}

TEST(World, StartsAtRestAtTheOrigin) {
  for (const auto kind :
       {TerrainKind::kFlat, TerrainKind::kSlope, TerrainKind::kRough, TerrainKind::kKerbs}) {
    World world(Husky(), Square(kind), 1);
    world.Advance();
    const auto truth = world.TruthNow();
    EXPECT_EQ(truth.t_ns, 0);
    EXPECT_LT(truth.X_WB.p.head<2>().norm(), 0.005);  // the tyres give by a few millimetres
    EXPECT_NEAR(std::atan2(truth.X_WB.R(1, 0), truth.X_WB.R(0, 0)), 0.0, 2e-3);
    EXPECT_LT(truth.v_WB.norm(), 1e-5);
    EXPECT_LT(truth.w_WB_B.norm(), 1e-5);
    // The tyres carry the robot: the loads are vertical up to the ground's tilt.
    EXPECT_NEAR(truth.wheel_load_n.sum(), 56.582 * 9.81, 0.03 * 555);
  }
}

TEST(World, LooksOneStepAhead) {
  World world(Husky(), Square(TerrainKind::kRough), 1);
  world.Advance();
  for (int i = 0; i < 2000; ++i) {
    const MotionWindow before = world.motion();
    world.Advance();
    const MotionWindow& after = world.motion();
    ASSERT_EQ(after.t_ns, before.t_ns + 1'000'000);
    ASSERT_EQ(after.X_WB.p, before.X_WB_next.p);
    ASSERT_EQ(after.X_WB_previous.R, before.X_WB.R);
  }
}

TEST(World, JointsBelongToTheirInstantAndOrder) {
  WorldConfig config;
  config.motion.path = PathKind::kVelocityProfile;
  config.motion.start_s = 0.0;
  config.motion.profile = {{0.0, 0.0, 0.6}};  // turn left: the left wheels go backwards
  World world(Husky(), config, 1);
  models::EncoderVector angle;
  for (int i = 0; i < 1500; ++i) {
    angle = world.motion().joint_angle_rad;
    world.Advance();
    if (i == 0) continue;
    // Euler's joint update: q_k = q_k−1 + h ω_k.
    const models::EncoderVector step = world.motion().joint_angle_rad - angle;
    ASSERT_LT((step - 0.001 * world.motion().joint_rate_rad_s).norm(), 1e-12);
  }
  for (const int left : {0, 1}) EXPECT_LT(world.motion().joint_rate_rad_s(left), -0.9);
  for (const int right : {2, 3}) EXPECT_GT(world.motion().joint_rate_rad_s(right), 0.9);
  EXPECT_GT(world.TruthNow().w_WB_B.z(), 0.2);
  EXPECT_GT(world.TruthNow().wheel_slip_m_s.minCoeff(), 0.05);  // a skid-steer slides when it turns
}

TEST(World, TruthIsTheCentralDifferenceOfPoses) {
  World world(Husky(), Square(TerrainKind::kRough), 3);
  std::vector<models::Pose> poses;
  std::vector<ground_truth::Truth> truths;
  for (int i = 0; i < 3000; ++i) {
    world.Advance();
    truths.push_back(world.TruthNow());
  }
  for (std::size_t i = 1; i + 1 < truths.size(); ++i) {
    const Eigen::Vector3d v = (truths[i + 1].X_WB.p - truths[i - 1].X_WB.p) / 0.002;
    ASSERT_LT((truths[i].v_WB - v).norm(), 1e-12);
    // First order in the small turn: R_k−1ᵀ R_k+1 − 1 = 2h [ω]× + O((2hω)²), ω below 1 rad/s.
    const Eigen::Matrix3d dR = truths[i - 1].X_WB.R.transpose() * truths[i + 1].X_WB.R;
    const Eigen::Vector3d w =
        Eigen::Vector3d(dR(2, 1) - dR(1, 2), dR(0, 2) - dR(2, 0), dR(1, 0) - dR(0, 1)) / 0.004;
    ASSERT_LT((truths[i].w_WB_B - w).norm(), 1e-5);
  }
}

TEST(World, TheSameArgumentsGiveTheSameBytes) {
  const int steps = 1500;
  const WorldConfig rough = Square(TerrainKind::kRough), kerbs = Square(TerrainKind::kKerbs);
  const auto alone_rough = Trace(rough, 5, steps), alone_kerbs = Trace(kerbs, 6, steps);

  World a(Husky(), rough, 5), b(Husky(), kerbs, 6);  // interleaved on one thread
  std::vector<double> both_rough, both_kerbs;
  for (int i = 0; i < steps; ++i) {
    a.Advance();
    b.Advance();
    Append(both_rough, a);
    Append(both_kerbs, b);
  }
  EXPECT_EQ(both_rough, alone_rough);
  EXPECT_EQ(both_kerbs, alone_kerbs);

  std::vector<double> threaded_rough, threaded_kerbs;
  std::thread one([&] { threaded_rough = Trace(rough, 5, steps); });
  std::thread two([&] { threaded_kerbs = Trace(kerbs, 6, steps); });
  one.join();
  two.join();
  EXPECT_EQ(threaded_rough, alone_rough);
  EXPECT_EQ(threaded_kerbs, alone_kerbs);

  EXPECT_NE(Trace(rough, 7, steps), alone_rough);  // another seed is another ground
}

TEST(World, DrivesItsSquare) {
  World world(Husky(), Square(TerrainKind::kFlat), 1);
  Eigen::Vector2d low(0, 0), high(0, 0);
  for (int i = 0; i < 25000; ++i) {
    world.Advance();
    low = low.cwiseMin(world.motion().X_WB.p.head<2>());
    high = high.cwiseMax(world.motion().X_WB.p.head<2>());
  }
  // A square of 3 m, counter-clockwise from the origin; the driver swings out of corners by half a
  // metre.
  EXPECT_NEAR(high.x(), 3.0, 0.6);
  EXPECT_NEAR(high.y(), 3.0, 0.6);
  EXPECT_GT(low.minCoeff(), -0.6);
}

TEST(World, ALargerWheelGoesFarther) {
  WorldConfig config;
  config.motion.path = PathKind::kVelocityProfile;
  config.motion.profile = {{0.0, 0.8, 0.0}};
  const auto way = [&](double scale) {
    config.actual.wheel_radius_scale = {scale, scale};
    World world(Husky(), config, 1);
    for (int i = 0; i < 10000; ++i) world.Advance();
    return world.motion().X_WB.p.x();
  };
  // The rolling radius is R − δ/3, δ/3 = 1.4 mm of 165: the ratio is 1.02 up to 0.02 · 0.9 %.
  EXPECT_NEAR(way(1.02) / way(1.0), 1.02, 4e-4);
}

TEST(World, IceHasLessGrip) {
  WorldConfig config;
  config.motion.path = PathKind::kVelocityProfile;
  config.motion.profile = {{0.0, 0.8, 0.0}};
  config.patches = {{{0, 0, 60, 60}, 0.02}};
  World world(Husky(), config, 1);
  for (int i = 0; i < 2500; ++i) world.Advance();
  // 1.5 s after the start: at most μ g t = 0.02 · 9.81 · 1.5, where dry ground reaches the 0.8 m/s.
  EXPECT_LT(world.TruthNow().v_WB.x(), 0.02 * 9.81 * 1.5 + 0.01);
  EXPECT_GT(world.TruthNow().wheel_slip_m_s.minCoeff(), 0.3);
}

TEST(World, LeavingTheMapEndsTheRun) {
  WorldConfig config = Square(TerrainKind::kFlat);
  config.motion.side_m = 10.0;
  config.terrain.half_size_m = 2.0;
  World world(Husky(), config, 1);
  const auto message = Message<WorldFailure>([&] {
    for (int i = 0; i < 10000; ++i) world.Advance();
  });
  EXPECT_NE(message.find("the robot left the map (|x|, |y| ≤ 2 m) at x = 2.0"), std::string::npos)
      << message;
  EXPECT_NE(message.find(" t = 3."), std::string::npos) << message;  // 2 m at 0.8 m/s, after a ramp
}

TEST(World, TurningOverEndsTheRun) {
  WorldConfig config = Square(TerrainKind::kSlope);
  config.terrain.angle_deg = 20.0;
  config.terrain.uphill_deg = 90.0;
  config.actual.com_offset_m = {0, 0, 1.0};  // tips at atan(0.278 / 1.0) = 15.5°
  const auto message = Message<WorldFailure>([&] { World(Husky(), config, 1); });
  EXPECT_NE(message.find("the robot turned over"), std::string::npos) << message;
}

TEST(World, APhysicsWarningEndsTheRunInSilence) {
  const auto log = std::filesystem::current_path() / "MUJOCO_LOG.TXT";
  const bool before = std::filesystem::exists(log);
  RobotConfig robot = Husky();
  robot.skid_steer().normal_damping_n_s_m = 1e7;  // unstable at 1 ms
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  WorldConfig config;
  config.actual.mass_scale = 1.2;  // starts too high or too low, so it moves
  config.terrain.kind = TerrainKind::kRough;
  const auto message = Message<WorldFailure>([&] {
    World world(robot, config, 1);
    for (int i = 0; i < 1000; ++i) world.Advance();
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_NE(message, "(nothing was thrown)");
  EXPECT_EQ(std::filesystem::exists(log), before);
}

TEST(World, APhysicsErrorIsAnExceptionNotTheEndOfTheProcess) {
  World world(Husky(), {}, 1);  // installs the handler
  EXPECT_NE(Message<WorldFailure>([] { mju_error("out of %s", "memory"); }).find("out of memory"),
            std::string::npos);
}

TEST(World, RefusesAWorldThatCannotBeBuilt) {
  const auto refusal = [](const std::function<void(RobotConfig&, WorldConfig&)>& edit) {
    RobotConfig robot = Husky();
    WorldConfig config;
    edit(robot, config);
    return Message<std::invalid_argument>([&] { World(robot, config, 1); });
  };
  const auto names = [](const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos ? testing::AssertionSuccess()
                                                   : testing::AssertionFailure() << message;
  };
  EXPECT_TRUE(
      names(refusal([](auto& r, auto&) { r.urdf_path = "/no/such.urdf"; }), "/no/such.urdf"));
  EXPECT_TRUE(names(refusal([](auto& r, auto&) { r.skid_steer().right_joints[0] = "no_wheel"; }),
                    "no_wheel"));
  EXPECT_TRUE(names(refusal([](auto&, auto& c) { c.physics_step_s = -0.001; }), "physics_step_s"));
  EXPECT_TRUE(names(refusal([](auto&, auto& c) { c.physics_step_s = NAN; }), "physics_step_s"));
  EXPECT_TRUE(names(refusal([](auto&, auto& c) { c.gravity_m_s2 = -9.81; }), "gravity_m_s2"));
  EXPECT_TRUE(names(refusal([](auto&, auto& c) { c.settle_s = -1; }), "settle_s"));
  EXPECT_TRUE(
      names(refusal([](auto&, auto& c) { c.motion.path = PathKind::kWaypoints; }), "waypoints_m"));
  EXPECT_TRUE(names(refusal([](auto&, auto& c) {
                      c.terrain.kind = TerrainKind::kSlope;
                      c.terrain.angle_deg = 35;
                      c.terrain.friction = 0.5;  // tan 35° = 0.70
                    }),
                    "does not come to rest"));
}

TEST(World, OtherPhysicsStepsWork) {
  for (const double step_s : {0.0005, 0.002, 0.004}) {
    WorldConfig config = Square(TerrainKind::kRough);
    config.motion.side_m = 10.0;
    config.physics_step_s = step_s;
    World world(Husky(), config, 1);
    while (world.motion().t_ns < 8 * models::kNsPerSecond) world.Advance();
    // 7.9 s at 0.8 m/s less the ramp and the tyres' slip.
    EXPECT_NEAR(world.motion().X_WB.p.x(), 5.85, 0.15) << "step " << step_s;
  }
}

}  // namespace
}  // namespace reckon::sim
