// Long runs of the simulated robot.
#include <gtest/gtest.h>

#include "reckon/sim/world.h"
#include "sim/husky.h"

namespace reckon::sim {
namespace {

class LongLoop : public testing::TestWithParam<TerrainKind> {};

TEST_P(LongLoop, RunsForTenMinutes) {
  WorldConfig config;
  config.terrain.kind = GetParam();
  config.motion.path = PathKind::kSquare;
  World world(Husky(), config, 1);
  double way = 0.0;
  while (world.motion().t_ns < 600 * models::kNsPerSecond) {
    world.Advance();  // throws on any warning of the physics engine
    way += world.TruthNow().v_WB.head<2>().norm() * 0.001;
  }
  EXPECT_GT(way, 420.0);  // 600 s at 0.8 m/s less the corners
  EXPECT_LT(world.motion().X_WB.p.head<2>().lpNorm<Eigen::Infinity>(),
            11.5);  // still on its square
}

INSTANTIATE_TEST_SUITE_P(Terrains, LongLoop,
                         testing::Values(TerrainKind::kFlat, TerrainKind::kRough,
                                         TerrainKind::kKerbs));

}  // namespace
}  // namespace reckon::sim
