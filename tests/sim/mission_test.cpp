#include "reckon/sim/mission.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reckon/sim/navigator.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

double FlatAt10(double, double) { return 10.0; }

MissionConfig Of(MissionKind kind) {
  MissionConfig mission;
  mission.kind = kind;
  return mission;
}

TEST(Route, IsFollowedByArcLength) {
  const Route route({{0, 0, 0}, {3, 0, 0}, {3, 0, 0}, {3, 4, 0}});
  EXPECT_EQ(route.length(), 7.0);
  EXPECT_EQ(route.At(-1.0), Vector3d(0, 0, 0));
  EXPECT_EQ(route.At(5.0), Vector3d(3, 2, 0));
  EXPECT_EQ(route.At(99.0), Vector3d(3, 4, 0));
  EXPECT_EQ(route.Direction(1.0), Vector3d::UnitX());
  EXPECT_EQ(route.Direction(6.0), Vector3d::UnitY());
  EXPECT_EQ(route.Nearest({2, -1, 0}, 0.0, 3.0), 2.0);
  EXPECT_EQ(route.Nearest({3.5, 1, 0}, 2.5, 3.0), 4.0);
  EXPECT_EQ(route.Nearest({3.5, 3, 0}, 2.5, 3.0), 5.5) << "no further than the window";
  EXPECT_EQ(route.Nearest({0, 0, 0}, 2.5, 3.0), 2.5) << "never back";
  const Route point({{1, 2, 3}});
  EXPECT_EQ(point.length(), 0.0);
  EXPECT_EQ(point.At(1.0), Vector3d(1, 2, 3));
  EXPECT_EQ(point.Direction(0.0), Vector3d::Zero());
}

TEST(Mission, GoesDownFirst) {
  for (const auto kind : {MissionKind::kHover, MissionKind::kDive, MissionKind::kSquare,
                          MissionKind::kLawnmower, MissionKind::kHelix}) {
    const auto legs = LegsOf(Of(kind));
    EXPECT_EQ(legs.front().route.At(0.0), Vector3d(0, 0, -1));
    EXPECT_EQ(legs.front().route.At(1e9), Vector3d(0, 0, -5));
  }
}

TEST(Mission, HasTheLengthsOfItsFigures) {
  EXPECT_EQ(LegsOf(Of(MissionKind::kHover)).size(), 1U);
  const auto dive = LegsOf(Of(MissionKind::kDive));
  EXPECT_EQ(dive.front().hold_s, 10.0);
  EXPECT_EQ(dive.back().route.At(1e9), Vector3d(0, 0, -1));
  MissionConfig square = Of(MissionKind::kSquare);
  square.laps = 1.625;
  EXPECT_NEAR(LegsOf(square).back().route.length(), 65.0, 1e-12);
  EXPECT_LT((LegsOf(square).back().route.At(1e9) - Vector3d(10, 10, -5)).norm(), 5.0 + 1e-12);
  // Six tracks of 20 m and five steps of 4 m.
  EXPECT_NEAR(LegsOf(Of(MissionKind::kLawnmower)).back().route.length(), 140.0, 1e-12);
  const Route helix = LegsOf(Of(MissionKind::kHelix)).back().route;
  const double circles = 3 * 2 * std::numbers::pi * 4.0;
  EXPECT_NEAR(helix.length(), std::hypot(circles, 3.0), 0.05);  // 72 chords a turn
  EXPECT_LT((helix.At(1e9) - Vector3d(0, 0, -8)).norm(), 1e-9);
  MissionConfig right = Of(MissionKind::kSquare);
  right.clockwise = true;
  EXPECT_EQ(LegsOf(right).back().route.At(20.0), Vector3d(10, -10, -5));
}

TEST(Mission, IsImpossibleAboveTheSurfaceAndUnderTheSeabed) {
  const auto trouble = [](const MissionConfig& mission, double room = 0.13) {
    return MissionTrouble(LegsOf(mission), FlatAt10, room).value_or("");
  };
  MissionConfig mission = Of(MissionKind::kLawnmower);
  EXPECT_EQ(trouble(mission), "");
  mission.depth_m = 9.9;
  EXPECT_EQ(trouble(mission), "");
  mission.depth_m = 10.5;
  EXPECT_NE(trouble(mission).find("leads under the seabed: 10"), std::string::npos);
  mission = Of(MissionKind::kHover);
  mission.start_depth_m = 0.1;
  EXPECT_NE(trouble(mission).find("leads above the surface: 0.1 m deep"), std::string::npos);
  EXPECT_EQ(trouble(mission, 0.05), "");
  mission.start_depth_m = -2.0;
  EXPECT_NE(trouble(mission).find("leads above the surface: -2 m"), std::string::npos);
  mission = Of(MissionKind::kHelix);
  mission.end_depth_m = 11.0;
  EXPECT_NE(trouble(mission).find("under the seabed"), std::string::npos);
  mission = Of(MissionKind::kWaypoints);
  mission.waypoints_m = {{5, 0, 4}, {5, 5, -1}};
  EXPECT_NE(trouble(mission).find("above the surface"), std::string::npos);
}

TEST(Mission, RefusesNumbersThatMeanNothing) {
  const auto refusal = [](const std::function<void(MissionConfig&)>& change) -> std::string {
    MissionConfig mission;
    change(mission);
    try {
      (void)LegsOf(mission);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto names = [](const std::string& text, const char* key) {
    return text.find(key) != std::string::npos;
  };
  EXPECT_TRUE(names(refusal([](auto& m) { m.speed_m_s = 0; }), "speed_m_s"));
  EXPECT_TRUE(names(refusal([](auto& m) { m.side_m = -1; }), "side_m"));
  EXPECT_TRUE(names(refusal([](auto& m) { m.tracks = 0; }), "tracks"));
  EXPECT_TRUE(names(refusal([](auto& m) { m.depth_m = NAN; }), "depth_m"));
  EXPECT_TRUE(names(refusal([](auto& m) { m.kind = MissionKind::kWaypoints; }), "waypoints_m"));
}

TEST(Navigator, HeadsForThePointAheadAndTurnsBeforeItRuns) {
  MissionConfig mission = Of(MissionKind::kLawnmower);
  mission.start_depth_m = mission.depth_m;
  Navigator navigator(mission);
  models::Pose X_WB;
  X_WB.p = {0, 0, -5};
  EXPECT_EQ(navigator.Update(0.5, X_WB).velocity_m_s.norm(), 0.0) << "it waits for start_s";
  (void)navigator.Update(2.0, X_WB);  // arrived at depth
  const Course ahead = navigator.Update(2.02, X_WB);
  EXPECT_NEAR(ahead.velocity_m_s.x(), 0.5, 1e-12);
  EXPECT_NEAR(ahead.heading_rad, 0.0, 1e-12);
  X_WB.R = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(navigator.Update(2.04, X_WB).velocity_m_s.norm(), 0.1, 1e-12) << "a fifth";
  X_WB.p.z() = -4.9;
  EXPECT_NEAR(navigator.Update(2.06, X_WB).velocity_m_s.z(), -0.04, 1e-12);
}

}  // namespace
}  // namespace reckon::sim
