#include "reckon/sim/underwater_vehicle.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reckon/sim/world.h"
#include "sim/bluerov2.h"
#include "sim/message.h"

namespace reckon::sim {
namespace {

using testing_sim::Message;

using Eigen::Vector3d;

constexpr double kMassKg = 13.5, kRho = 1025.0, kG = 9.81;

/// Where the robot is every tenth of a second.
std::vector<ground_truth::Truth> Fly(const RobotConfig& robot, const WorldConfig& config,
                                     double seconds, std::uint64_t seed = 1) {
  World world(robot, config, seed);
  std::vector<ground_truth::Truth> track;
  for (long long k = 0; k <= std::llround(seconds * 1e3); ++k) {
    world.Advance();
    if (k % 100 == 0) track.push_back(world.TruthNow());
  }
  return track;
}

/// Nobody steers.
RobotConfig Adrift() {
  RobotConfig robot = BlueRov2();
  std::get<UnderwaterConfig>(robot.drive).autopilot = {.surge_n_s_m = 0,
                                                       .surge_n_m = 0,
                                                       .sway_n_s_m = 0,
                                                       .sway_n_m = 0,
                                                       .heave_n_s_m = 0,
                                                       .heave_n_m = 0,
                                                       .tilt_n_m_rad = 0,
                                                       .tilt_n_m_s = 0,
                                                       .yaw_n_m_s = 0};
  return robot;
}

TEST(UnderwaterVehicle, AdriftItRisesAtItsTerminalSpeed) {
  WorldConfig config = Sea();
  config.mission.start_depth_m = config.mission.depth_m = 8.0;
  const Vector3d v = Fly(Adrift(), config, 60.0).back().v_WB;
  const double lift = kRho * kG * 0.0134 - kMassKg * kG;
  const double up = (-33.0 + std::sqrt(33.0 * 33.0 + 4 * 190.0 * lift)) / (2 * 190.0);
  EXPECT_NEAR(v.z(), up, 1e-9);
}

TEST(UnderwaterVehicle, AdriftItGoesWithTheWater) {
  WorldConfig config = Sea();
  config.mission.start_depth_m = config.mission.depth_m = 8.0;
  config.water->current.mean_m_s = {0.2, -0.1, 0.0};
  const Vector3d v = Fly(Adrift(), config, 60.0).back().v_WB;
  // Surge and sway lose their speed against the water at a rate that falls with it: to 13.7 N s/m
  // (surge alone has a linear part).
  EXPECT_NEAR(v.x(), 0.2, 2e-3);
  EXPECT_NEAR(v.y(), -0.1, 5e-3);
}

TEST(UnderwaterVehicle, HeavierThanWaterItComesToRestOnTheBottom) {
  RobotConfig robot = Adrift();
  std::get<UnderwaterConfig>(robot.drive).hydrodynamics.volume_m3 = 0.0128;
  WorldConfig config = Sea();
  config.mission.start_depth_m = config.mission.depth_m = 9.5;
  const auto on_plane = Fly(robot, config, 30.0);
  EXPECT_NEAR(on_plane.back().X_WB.p.z(), -10.0 + kHalfHull, 1e-3);
  EXPECT_LT(on_plane.back().v_WB.norm(), 1e-6);
  config.terrain.kind = TerrainKind::kSlope;
  config.terrain.angle_deg = 10.0;  // friction holds it
  const auto on_slope = Fly(robot, config, 30.0);
  EXPECT_NEAR(std::acos(on_slope.back().X_WB.R(2, 2)), 10.0 * std::numbers::pi / 180, 1e-3);
  // MuJoCo's contacts creep: their friction is not quite hard.
  EXPECT_LT(on_slope.back().v_WB.norm(), 1e-3);
  config.terrain = {.kind = TerrainKind::kRough, .rms_m = 0.1};
  const auto on_rough = Fly(robot, config, 30.0);
  EXPECT_LT(on_rough.back().v_WB.norm(), 1e-3);
  EXPECT_LT(on_rough.back().X_WB.p.z(), -9.3);
}

TEST(UnderwaterVehicle, HoldsItsPlaceInTheCurrent) {
  WorldConfig config = Sea();
  config.water->current = {.mean_m_s = {0.2, 0.15, 0}, .sigma_m_s = 0.05};
  config.mission.start_depth_m = config.mission.depth_m = 5.0;
  config.settle_s = 20.0;  // until the integrals hold it
  for (const auto& truth : Fly(BlueRov2(), config, 120.0)) {
    EXPECT_LT((truth.X_WB.p - Vector3d(0, 0, -5)).norm(), 0.05);
    EXPECT_GT(truth.X_WB.R(2, 2), std::cos(0.05));
  }
}

TEST(UnderwaterVehicle, FliesItsMissions) {
  for (const auto kind : {MissionKind::kDive, MissionKind::kSquare, MissionKind::kLawnmower,
                          MissionKind::kHelix, MissionKind::kWaypoints}) {
    WorldConfig config = Sea();
    config.water->current = {.mean_m_s = {0.1, 0.05, 0}, .sigma_m_s = 0.05};
    config.mission.kind = kind;
    config.mission.tracks = 3;
    config.mission.waypoints_m = {{8, 0, 3}, {8, -6, 7}, {0, 0, 4}};
    const auto track = Fly(BlueRov2(), config, 400.0);
    // Every point of the mission is passed at less than half a metre, in order.
    std::size_t at = 0;
    for (const Leg& leg : LegsOf(config.mission)) {
      for (double s = 0.0; s <= leg.route.length(); s += 0.5) {
        const Vector3d point = leg.route.At(s);
        while (at < track.size() && (track[at].X_WB.p - point).norm() > 0.5) ++at;
        ASSERT_LT(at, track.size())
            << "mission " << static_cast<int>(kind) << " misses " << point.transpose();
      }
    }
    const Vector3d end = LegsOf(config.mission).back().route.At(1e9);
    EXPECT_LT((track.back().X_WB.p - end).norm(), 0.05) << static_cast<int>(kind);
  }
}

TEST(UnderwaterVehicle, TouchesTheBottomAndLeavesIt) {
  WorldConfig config = Sea();
  config.mission = {
      .kind = MissionKind::kDive, .start_depth_m = 8.0, .depth_m = 9.95, .hold_s = 20.0};
  const auto track = Fly(BlueRov2(), config, 90.0);
  double lowest = 0.0, rested_s = 0.0;
  for (const auto& truth : track) {
    lowest = std::min(lowest, truth.X_WB.p.z());
    if (truth.X_WB.p.z() < -10.0 + kHalfHull + 1e-3) rested_s += 0.1;
  }
  EXPECT_NEAR(lowest, -10.0 + kHalfHull, 5e-3) << "it can't sink into the ground";
  EXPECT_GT(rested_s, 10.0);
  EXPECT_NEAR(track.back().X_WB.p.z(), -8.0, 0.02);
}

TEST(UnderwaterVehicle, TheSameSeedGivesTheSameBits) {
  WorldConfig config = Sea();
  config.water->current.sigma_m_s = 0.05;
  config.mission.kind = MissionKind::kSquare;
  const auto first = Fly(BlueRov2(), config, 20.0, 3), again = Fly(BlueRov2(), config, 20.0, 3),
             other = Fly(BlueRov2(), config, 20.0, 4);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].X_WB.p, again[i].X_WB.p);
    ASSERT_EQ(first[i].X_WB.R, again[i].X_WB.R);
  }
  EXPECT_NE(first.back().X_WB.p, other.back().X_WB.p);
}

TEST(UnderwaterVehicle, ARunEndsWhereItsModelEnds) {
  WorldConfig config = Sea();
  config.mission.start_depth_m = config.mission.depth_m = 0.5;
  config.settle_s = 0.0;
  const auto surfaces = Message<WorldFailure>([&] { Fly(Adrift(), config, 60.0); });
  EXPECT_NE(surfaces.find("broke the surface"), std::string::npos) << surfaces;
  config = Sea();
  config.terrain.half_size_m = 3.0;
  config.mission.kind = MissionKind::kSquare;
  config.mission.side_m = 5.0;
  const auto leaves = Message<WorldFailure>([&] { Fly(BlueRov2(), config, 60.0); });
  EXPECT_NE(leaves.find("left the map"), std::string::npos) << leaves;
}

TEST(UnderwaterVehicle, RefusesWhatCantBe) {
  const auto refusal = [](const std::function<void(RobotConfig&, WorldConfig&)>& change) {
    RobotConfig robot = BlueRov2();
    WorldConfig config = Sea();
    change(robot, config);
    return Message<std::invalid_argument>([&] { World(robot, config, 1); });
  };
  const auto names = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  names(refusal([](auto&, auto& w) { w.mission.depth_m = 11.0; }), "under the seabed");
  names(refusal([](auto&, auto& w) { w.mission.start_depth_m = 0.1; }), "above the surface");
  // A boulder lies where the mission goes.
  names(
      refusal([](auto&, auto& w) {
        w.mission.kind = MissionKind::kSquare;
        w.water->features = {{.kind = FeatureKind::kBoulder, .at_m = {5, 0}, .size_m = {4, 4, 12}}};
      }),
      "under the seabed");
  names(refusal([](auto&, auto& w) { w.water.reset(); }), "no water");
  names(refusal([](auto&, auto& w) { w.terrain.kind = TerrainKind::kKerbs; }), "seabed is flat");
  names(refusal([](auto& r, auto&) {
          std::get<UnderwaterConfig>(r.drive).hydrodynamics.added_mass(0, 0) = -1.0;
        }),
        "added_mass");
  names(refusal([](auto& r, auto&) { std::get<UnderwaterConfig>(r.drive).thrusters.clear(); }),
        "no thrusters");
  names(refusal(
            [](auto& r, auto&) { std::get<UnderwaterConfig>(r.drive).autopilot.yaw_n_m_s = -1.0; }),
        "yaw_n_m_s");
}

class SceneryTest : public ::testing::Test {
 protected:
  std::optional<RayHit> Cast(const WorldConfig& config, const Vector3d& from,
                             const Vector3d& direction) const {
    const World world(BlueRov2(), config, 1);
    return world.environment().surroundings->Cast(from, direction.normalized());
  }
  const Vector3d down_ = -Vector3d::UnitZ();
};

TEST_F(SceneryTest, RaysMeetTheSeabedAndNotTheRobot) {
  const auto hit = Cast(Sea(), {0, 0, -1}, down_);  // from the middle of the robot
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 9.0, 1e-12);
  EXPECT_NEAR(hit->cos_incidence, 1.0, 1e-12);
  EXPECT_FALSE(Cast(Sea(), {0, 0, -1}, Vector3d::UnitZ()));
  const auto slanted = Cast(Sea(), {0, 0, -1}, {1, 0, -1});
  EXPECT_NEAR(slanted->range_m, 9.0 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(slanted->cos_incidence, std::sqrt(0.5), 1e-12);
}

TEST_F(SceneryTest, ASlopeRisesWhereItIsToldTo) {
  WorldConfig config = Sea();
  config.terrain.kind = TerrainKind::kSlope;
  config.terrain.angle_deg = 20.0;
  config.terrain.uphill_deg = 90.0;
  const auto hit = Cast(config, {3, 5, 0}, down_);
  const double rise = std::tan(20.0 * std::numbers::pi / 180);
  EXPECT_NEAR(hit->range_m, 10.0 - 5.0 * rise, 1e-9);
  EXPECT_NEAR(hit->cos_incidence, std::cos(20.0 * std::numbers::pi / 180), 1e-9);
}

TEST_F(SceneryTest, ARoughSeabedIsTheTerrainBetweenItsNodes) {
  WorldConfig config = Sea();
  config.terrain = {.kind = TerrainKind::kRough,
                    .half_size_m = 20.0,
                    .rms_m = 0.3,
                    .shortest_wave_m = 2.0,
                    .longest_wave_m = 20.0};
  const World world(BlueRov2(), config, 1);
  const Seabed seabed(config, 1);
  double square = 0.0, height = 0.0;
  int count = 0;
  for (double x = -18.0; x <= 18.0; x += 1.37) {
    for (double y = -18.0; y <= 18.0; y += 1.19, ++count) {
      const auto hit = world.environment().surroundings->Cast({x, y, 0}, down_);
      ASSERT_TRUE(hit);
      square += std::pow(hit->range_m - seabed.Depth(x, y), 2);
      height += std::pow(10.0 - seabed.Depth(x, y), 2);
    }
  }
  // Flat triangles over nodes a quarter of the shortest wave apart: a few per cent of the height.
  EXPECT_LT(std::sqrt(square / count), 0.05 * std::sqrt(height / count));
  EXPECT_NEAR(std::sqrt(height / count), 0.3, 0.1);
}

TEST_F(SceneryTest, FeaturesLieOnTheGround) {
  WorldConfig config = Sea();
  config.water->features = {
      {.kind = FeatureKind::kBoulder, .at_m = {5, 0}, .size_m = {2, 2, 3}},
      {.kind = FeatureKind::kBlock, .at_m = {0, 5}, .size_m = {4, 1, 2}, .yaw_deg = 90.0},
      {.kind = FeatureKind::kPipe, .at_m = {-5, 0}, .size_m = {6, 0.8, 0.8}, .yaw_deg = 90.0}};
  const auto depth = [&](double x, double y) { return Cast(config, {x, y, 0}, down_)->range_m; };
  EXPECT_NEAR(depth(5, 0), 8.5, 1e-9);
  EXPECT_NEAR(depth(5.9, 0), 10.0 - 1.5 * std::sqrt(1 - 0.81), 1e-9);
  EXPECT_NEAR(depth(0, 5), 8.0, 1e-9);
  EXPECT_NEAR(depth(0, 6.9), 8.0, 1e-9) << "turned, it is long along y";
  EXPECT_NEAR(depth(0.6, 5), 10.0, 1e-9);
  EXPECT_NEAR(depth(-5, 2.9), 9.2, 1e-9);
  EXPECT_NEAR(depth(-4.5, 0), 10.0, 1e-9);
  EXPECT_NEAR(depth(-4.7, 0), 10.0 - 0.4 - std::sqrt(0.16 - 0.09), 1e-9);
}

}  // namespace
}  // namespace reckon::sim
