// The quadrupeds on their feet: statics of contact, and that they walk where they are told to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reckon/sim/world.h"
#include "sim/message.h"
#include "sim/quadrupeds.h"

namespace reckon::sim {
namespace {

using ground_truth::Truth;
using testing_sim::Message;

constexpr double kGravity = 9.81;

/// Runs for a while and calls `look(truth)` at every step from `from_s` on.
template <class Look>
void Watch(World& world, double from_s, double until_s, const Look& look) {
  for (double t = 0.0; t <= until_s; t += 0.001) {
    world.Advance();
    if (t >= from_s) look(world.TruthNow());
  }
}

double SumOfNormals(const Truth& truth) {
  double sum = 0.0;
  for (const auto& foot : truth.feet.foot) sum += foot.normal_n;
  return sum;
}

TEST(LeggedVehicle, StandsWithItsWholeWeightOnItsFeet) {
  World world(MiniCheetah(), Walk(0.0), 1);
  Watch(world, 1.0, 2.0, [](const Truth& truth) {
    ASSERT_EQ(truth.feet.count, 4);
    EXPECT_NEAR(SumOfNormals(truth), 9.06 * kGravity, 1e-3 * 9.06 * kGravity);
    for (const auto& foot : truth.feet.foot) {
      ASSERT_TRUE(foot.contact);
      EXPECT_NEAR(foot.normal.z(), 1.0, 1e-9);
    }
  });
}

TEST(LeggedVehicle, DoesNotCreepOnASlope) {
  WorldConfig config = Walk(0.0);
  config.terrain.kind = TerrainKind::kSlope;
  config.terrain.angle_deg = 10.0;
  World world(MiniCheetah(), config, 1);
  int gone = 0;
  double slip = 0.0;
  Watch(world, 15.0, 16.0, [&](const Truth& truth) {
    for (const auto& foot : truth.feet.foot) {
      gone += foot.contact ? 0 : 1;
      slip = std::max(slip, foot.slip_m_s);
    }
  });
  EXPECT_EQ(gone, 0);     // no chatter
  EXPECT_LT(slip, 3e-4);  // 0.2 mm/s measured, of 0.1 wanted; engine default 11
}

TEST(LeggedVehicle, TrotsAsFastAsItIsTold) {
  for (const RobotConfig& robot : {MiniCheetah(), Raibo()}) {
    World world(robot, Walk(0.5), 1);
    double square = 0.0;
    int rows = 0, airborne = 0;
    Watch(world, 4.0, 12.0, [&](const Truth& truth) {
      const double v = (truth.X_WB.R.transpose() * truth.v_WB).x();
      square += (v - 0.5) * (v - 0.5);
      ++rows;
      const auto& feet = truth.feet.foot;
      const bool diagonal = !feet[0].contact && !feet[3].contact && feet[1].contact;
      airborne += diagonal ? 1 : 0;
    });
    EXPECT_LT(std::sqrt(square / rows), 0.05) << robot.name;  // 0.02 and 0.026 measured
    EXPECT_GT(airborne, rows / 4) << robot.name;              // a trot: diagonal pairs lift
  }
}

TEST(LeggedVehicle, RollsOnItsFeetWithoutSkating) {
  World world(MiniCheetah(), Walk(0.5), 1);
  double rolled = 0.0, slipped = 0.0;
  int rows = 0;
  Watch(world, 4.0, 10.0, [&](const Truth& truth) {
    for (const auto& foot : truth.feet.foot) {
      if (!foot.contact) continue;
      rolled += foot.centre_m_s;
      slipped += foot.slip_m_s;
      ++rows;
    }
  });
  EXPECT_LT(slipped / rows, 0.01);   // 3.5 mm/s measured
  EXPECT_GT(rolled, 5.0 * slipped);  // the sphere's middle moves all the same
}

TEST(LeggedVehicle, ChangesNothingForAnotherSeedWithoutAnythingRandom) {
  World one(MiniCheetah(), Walk(0.5), 1), other(MiniCheetah(), Walk(0.5), 2);
  Watch(one, 9.0, 3.0, [](const Truth&) {});
  Watch(other, 9.0, 3.0, [](const Truth&) {});
  EXPECT_EQ(one.TruthNow().X_WB.p, other.TruthNow().X_WB.p);
}

TEST(LeggedVehicle, PushesDifferBySeed) {
  WorldConfig config = Walk(0.5);
  config.pushes = PushConfig{3.0, 2.0, 0.1};
  World one(MiniCheetah(), config, 1), other(MiniCheetah(), config, 2);
  Watch(one, 9.0, 3.0, [](const Truth&) {});
  Watch(other, 9.0, 3.0, [](const Truth&) {});
  EXPECT_NE(one.TruthNow().X_WB.p, other.TruthNow().X_WB.p);
}

TEST(LeggedVehicle, WalksInTheAirWithoutTouching) {
  WorldConfig config = Walk(0.4);
  config.control.in_air = true;
  World world(MiniCheetah(), config, 1);
  double highest = 0.0;
  models::FootVector down = models::FootVector::Zero(4);
  Watch(world, 2.0, 4.0, [&](const Truth& truth) {
    EXPECT_EQ(SumOfNormals(truth), 0.0);
    highest = std::max(highest, world.motion().joint_rate_rad_s.lpNorm<Eigen::Infinity>());
    down += world.motion().gait;
  });
  EXPECT_GT(highest, 2.0);                    // its legs swing
  EXPECT_NEAR(down[0] / 2000.0, 0.58, 0.05);  // by the schedule
}

TEST(LeggedVehicle, SinksIntoSoftGround) {
  WorldConfig config = Walk(0.0);
  config.terrain.contact = {0.04, 1.0, 0.2, 0.95, 0.05};
  World world(MiniCheetah(), config, 1);
  double height = 0.0;
  Watch(world, 1.0, 1.5, [&](const Truth& truth) { height = truth.X_WB.p.z(); });
  EXPECT_LT(height, 0.26);  // of 0.29 on hard ground; 44 mm measured
  EXPECT_GT(height, 0.22);
}

TEST(LeggedVehicle, SkatesWherePatchesAreIce) {
  WorldConfig config = Walk(0.4);
  config.patches = {{{2.0, 0.0, 1.0, 10.0}, 0.1}};
  World world(MiniCheetah(), config, 1);
  double on = 0.0, off = 0.0;
  Watch(world, 1.0, 9.0, [&](const Truth& truth) {
    const double x = truth.X_WB.p.x();
    for (const auto& foot : truth.feet.foot) {
      if (foot.normal_n > 1.0 && foot.tangential_n > 0.11 * foot.normal_n) {
        (std::abs(x - 2.0) < 0.2 ? on : off) += 1.0;
      }
    }
  });
  EXPECT_EQ(on, 0.0);  // all feet are on the patch: no force beyond its cone
  EXPECT_GT(off, 0.0);
}

TEST(LeggedVehicle, SaysHowItFell) {
  WorldConfig config = Walk(0.5);
  config.pushes = PushConfig{60.0, 2.0, 0.1};
  World world(MiniCheetah(), config, 1);
  const std::string message =
      Message<WorldFailure>([&] { Watch(world, 9.0, 10.0, [](const Truth&) {}); });
  EXPECT_NE(message.find("the robot fell"), std::string::npos) << message;
  EXPECT_NE(message.find("t = "), std::string::npos) << message;
}

TEST(LeggedVehicle, RefusesWhatCannotWalk) {
  const auto refusal = [](const RobotConfig& robot, const WorldConfig& config) {
    return Message<std::invalid_argument>([&] { const World world(robot, config, 1); });
  };
  RobotConfig robot = MiniCheetah();
  std::get<LeggedConfig>(robot.drive).feet[2] = "RR_toe";
  EXPECT_NE(refusal(robot, Walk(0.5)).find("there is no link 'RR_toe'"), std::string::npos);
  std::get<LeggedConfig>(robot.drive).feet[2] = "FR_foot";
  EXPECT_NE(refusal(robot, Walk(0.5)).find("moves more than one foot"), std::string::npos);
  robot = MiniCheetah();
  std::get<LeggedConfig>(robot.drive).armature_kg_m2 = {0.1};
  EXPECT_NE(refusal(robot, Walk(0.5)).find("armature_kg_m2 must have one entry"),
            std::string::npos);
  WorldConfig config = Walk(0.5);
  config.control.gait.duty = 0.0;
  EXPECT_NE(refusal(MiniCheetah(), config).find("duty is 0"), std::string::npos);
  config = Walk(0.5);
  config.control.gait.offsets = std::vector<double>{0.0, 0.5};
  EXPECT_NE(refusal(MiniCheetah(), config).find("offsets has 2 entries"), std::string::npos);
}

}  // namespace
}  // namespace reckon::sim
