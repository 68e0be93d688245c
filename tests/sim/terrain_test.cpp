#include "reckon/sim/terrain.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

TerrainConfig Rough(double rms_m = 0.03) {
  TerrainConfig config;
  config.kind = TerrainKind::kRough;
  config.rms_m = rms_m;
  return config;
}

TEST(Terrain, FlatGroundIsFlat) {
  const Terrain terrain({}, {}, 1);
  const Ground ground = terrain.At(3.0, -7.0);
  EXPECT_EQ(ground.h, 0.0);
  EXPECT_EQ(ground.hx, 0.0);
  EXPECT_EQ(ground.hy, 0.0);
}

TEST(Terrain, SlopeRisesInItsDirection) {
  TerrainConfig config;
  config.kind = TerrainKind::kSlope;
  config.angle_deg = 30.0;
  config.uphill_deg = 90.0;  // towards +y
  const Terrain terrain(config, {}, 1);
  const double rise = std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(terrain.At(5.0, 2.0).h, 2.0 * rise, 1e-14);
  EXPECT_NEAR(terrain.At(5.0, 2.0).hx, 0.0, 1e-15);
  EXPECT_NEAR(terrain.At(5.0, 2.0).hy, rise, 1e-15);
}

TEST(Terrain, RoughGroundHasItsRms) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Terrain terrain(Rough(), {}, seed);
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (double x = -40; x <= 40; x += 0.37) {
      for (double y = -40; y <= 40; y += 0.37, ++count) {
        const double h = terrain.At(x, y).h;
        sum += h;
        squares += h * h;
      }
    }
    // The mean of a cosine of wavelength λ over a length L is at most λ/(πL), here 3 % for the
    // longest wave, and 64 waves with their cross terms average it down.
    EXPECT_NEAR(std::sqrt(squares / count), 0.03, 0.05 * 0.03) << "seed " << seed;
    EXPECT_NEAR(sum / count, 0.0, 0.03 * 0.03) << "seed " << seed;
  }
}

TEST(Terrain, RoughGroundIsItsSeeds) {
  const Terrain one(Rough(), {}, 1), again(Rough(), {}, 1), two(Rough(), {}, 2);
  EXPECT_EQ(one.At(1.23, 4.56).h, again.At(1.23, 4.56).h);
  EXPECT_GT(std::abs(one.At(1.23, 4.56).h - two.At(1.23, 4.56).h), 1e-4);
}

TEST(Terrain, RoughGroundIsSmooth) {
  const Terrain terrain(Rough(), {}, 7);
  const double e = 1e-5;
  // A cell border lies at every 0.1 m: steps across it and inside cells alike.
  for (double x = -1.05; x < 1.0; x += 0.05) {
    const double y = 0.1 + x / 3;
    const Ground ground = terrain.At(x, y);
    // A central difference errs by e² h'''/6 inside a cell and by e Δh''/4 where the second
    // derivative jumps; h'' is of the order of 1 /m here.
    EXPECT_NEAR(ground.hx, (terrain.At(x + e, y).h - terrain.At(x - e, y).h) / (2 * e), 1e-5);
    EXPECT_NEAR(ground.hy, (terrain.At(x, y + e).h - terrain.At(x, y - e).h) / (2 * e), 1e-5);
    EXPECT_NEAR(terrain.At(x + e, y).hx, terrain.At(x - e, y).hx, 1e-4);
  }
}

TEST(Terrain, InterpolationFollowsAWave) {
  // Waves of 2 m alone: every point obeys ∇²h = −(2π/λ)² h, which the table knows nothing of.
  TerrainConfig config = Rough(0.1);
  config.shortest_wave_m = config.longest_wave_m = 2.0;
  const Terrain terrain(config, {}, 3);
  const double e = 0.01, k2 = std::pow(2 * std::numbers::pi / 2.0, 2);
  double worst = 0.0;
  for (double x = -2.0; x < 2.0; x += 0.13) {
    const double y = 0.7 * x + 0.31;
    const double laplacian = (terrain.At(x + e, y).hx - terrain.At(x - e, y).hx +
                              terrain.At(x, y + e).hy - terrain.At(x, y - e).hy) /
                             (2 * e);
    worst = std::max(worst, std::abs(laplacian + k2 * terrain.At(x, y).h));
  }
  // Second derivatives of a cubic Hermite patch err by d²/12 h'''' ≈ (0.1 m)²/12 · k⁴ · 0.2 m.
  EXPECT_LT(worst, 0.01 / 12 * k2 * k2 * 0.2 * 2);
}

TEST(Terrain, TheLastPatchWins) {
  const Terrain terrain({}, {{{3, 0, 2, 2}, 0.15}, {{3.5, 0, 1, 1}, 0.5}}, 1);
  EXPECT_EQ(terrain.Friction(0, 0), 0.8);
  EXPECT_EQ(terrain.Friction(2.1, 0.9), 0.15);
  EXPECT_EQ(terrain.Friction(3.2, 0.1), 0.5);
  EXPECT_EQ(terrain.Friction(2.1, 1.1), 0.8);
}

TEST(Terrain, EndsAtItsEdge) {
  TerrainConfig config = Rough();
  config.half_size_m = 5.0;
  const Terrain terrain(config, {}, 1);
  EXPECT_TRUE(terrain.Contains(4.99, -4.99));
  EXPECT_FALSE(terrain.Contains(5.01, 0.0));
  EXPECT_FALSE(terrain.Contains(0.0, -5.01));
  EXPECT_LT(std::abs(terrain.At(5.6, 5.6).h), 0.2);  // wheels overhang the edge: still ground
}

TEST(Terrain, KerbsLeaveRoomToStart) {
  using Kerbs = std::array<std::optional<double>, 2>;
  TerrainConfig config;
  config.kind = TerrainKind::kKerbs;
  config.half_size_m = 7.0;
  config.kerb_spacing_m = 3.0;
  const Terrain terrain(config, {}, 1);
  EXPECT_EQ(terrain.KerbsAround(0.5), (Kerbs{std::nullopt, 3.0}));
  EXPECT_EQ(terrain.KerbsAround(-0.5), (Kerbs{-3.0, std::nullopt}));
  EXPECT_EQ(terrain.KerbsAround(4.4), (Kerbs{3.0, 6.0}));
  EXPECT_EQ(terrain.KerbsAround(6.9), (Kerbs{6.0, std::nullopt}));
}

TEST(Terrain, RefusesWhatCannotBe) {
  const auto refuses = [](const std::function<void(TerrainConfig&)>& edit, const std::string& key) {
    TerrainConfig config;
    edit(config);
    try {
      const Terrain terrain(config, {}, 1);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find(key) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refuses([](auto& c) { c.friction = -0.1; }, "friction"));
  EXPECT_TRUE(refuses([](auto& c) { c.half_size_m = -1; }, "half_size_m"));
  EXPECT_TRUE(refuses([](auto& c) { c.rolling_resistance = NAN; }, "rolling_resistance"));
  EXPECT_TRUE(refuses(
      [](auto& c) {
        c.kind = TerrainKind::kRough;
        c.rms_m = -0.01;
      },
      "rms_m"));
  EXPECT_TRUE(refuses(
      [](auto& c) {
        c.kind = TerrainKind::kRough;
        c.longest_wave_m = 0.5;
      },
      "longest_wave_m"));
  EXPECT_TRUE(refuses(
      [](auto& c) {
        c.kind = TerrainKind::kSlope;
        c.angle_deg = 90;
      },
      "angle_deg"));
  EXPECT_TRUE(refuses(
      [](auto& c) {
        c.kind = TerrainKind::kKerbs;
        c.kerb_spacing_m = 0.5;
      },
      "kerb_spacing_m"));
  EXPECT_THROW(Terrain({}, {{{0, 0, -1, 1}, 0.5}}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
