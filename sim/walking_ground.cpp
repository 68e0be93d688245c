#include "reckon/sim/walking_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/sim/ground_geoms.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/scenery.h"

namespace reckon::sim {
namespace {

constexpr double kOverhang = 1.0;     // m beyond the map
constexpr double kFinestRough = 0.1;  // m between the nodes of rough ground, at most
constexpr double kClearStart = 1.0;   // m around the origin without steps and debris
constexpr double kLanding = 1.2;      // m between two flights
constexpr double kMostPieces = 4000.0;
constexpr double kThin = 0.0005;  // m: half of a drawn patch's thickness

using Colour = float[4];
constexpr Colour kStep = {0.62F, 0.58F, 0.52F, 1.0F}, kWood = {0.62F, 0.45F, 0.26F, 1.0F},
                 kBrick = {0.62F, 0.30F, 0.22F, 1.0F}, kIce = {0.55F, 0.75F, 0.95F, 1.0F},
                 kGrip = {0.35F, 0.35F, 0.37F, 1.0F};

struct Box {
  double x, y, z;  ///< of its middle
  double half[3];
  double yaw_rad = 0.0;
};

mjsGeom* AddBox(const Box& box, const Colour& colour, mjsBody* world) {
  mjsGeom* geom = mjs_addGeom(world, nullptr);
  geom->type = mjGEOM_BOX;
  SetPosition(geom, box.x, box.y, box.z);
  std::copy(box.half, box.half + 3, geom->size);
  geom->quat[0] = std::cos(box.yaw_rad / 2.0);
  geom->quat[3] = std::sin(box.yaw_rad / 2.0);
  std::copy(colour, colour + 4, geom->rgba);
  geom->group = kSceneryGroup;
  return geom;
}

/// Flights up and down in turn, along x on both sides of the start.
void AddStairs(const TerrainConfig& terrain, mjsBody* world) {
  const double end = terrain.half_size_m + kOverhang;
  for (const double side : {1.0, -1.0}) {
    int level = 0, rise = 1;
    for (double x = kClearStart; x < end;) {
      level += rise;
      const bool last = level == 0 || level == terrain.steps;
      const double depth = last ? kLanding : terrain.step_depth_m;
      if (last) rise = -rise;
      const double top = level * terrain.step_height_m;
      const Box step{side * (x + depth / 2.0), 0.0, top / 2.0, {depth / 2.0, end, top / 2.0}};
      if (level > 0) SetGroundContact(terrain, 1, AddBox(step, kStep, world));
      x += depth;
    }
  }
}

/// Bars, bricks and boards, a third each, as high as chance has it.
void AddDebris(const TerrainConfig& terrain, std::uint64_t seed, mjsBody* world) {
  const RandomStream random(seed, "debris");
  const double half = terrain.half_size_m;
  const double wanted = std::min(kMostPieces, terrain.pieces_per_m2 * 4.0 * half * half);
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(wanted); ++i) {
    const double x = half * (2.0 * random.Uniform(0, i) - 1.0);
    const double y = half * (2.0 * random.Uniform(1, i) - 1.0);
    const double high = terrain.piece_height_m * (0.3 + 0.7 * random.Uniform(2, i));
    const double yaw = std::numbers::pi * random.Uniform(3, i), size = random.Uniform(4, i);
    if (std::hypot(x, y) < kClearStart) continue;
    Box box{x, y, 0.0, {0.25 + 0.2 * size, 0.02 + 0.01 * size, high}, yaw};  // bar
    const auto kind = static_cast<int>(3.0 * random.Uniform(5, i));
    if (kind == 1) box = {x, y, 0.0, {0.12, 0.06, high}, yaw};                   // brick
    if (kind == 2) box = {x, y, 0.0, {0.3 + 0.2 * size, 0.1, high / 2.0}, yaw};  // board
    SetGroundContact(terrain, 1, AddBox(box, kind == 1 ? kBrick : kWood, world));
  }
}

HeightSamples Gravel(const TerrainConfig& terrain, std::uint64_t seed) {
  const RandomStream random(seed, "gravel");
  const double spacing = terrain.stone_m / 2.0;
  const auto height = [random, spacing, high = terrain.stone_height_m](double x, double y) {
    constexpr double kMiddle = 100000.0;  // nodes, so that no index is negative
    const auto row = static_cast<std::uint32_t>(std::lround(y / spacing + kMiddle));
    return high *
           random.Uniform(row, static_cast<std::uint64_t>(std::lround(x / spacing + kMiddle)));
  };
  return {terrain.half_size_m + kOverhang, spacing, height};
}

mjsGeom* AddBase(const Terrain& terrain, std::uint64_t seed, mjSpec* spec, mjsBody* world) {
  const TerrainConfig& config = terrain.config();
  if (config.kind == TerrainKind::kGravel) {
    return AddHeightfield(spec, world, "gravel", Gravel(config, seed), 0.0, "ground");
  }
  if (config.kind == TerrainKind::kRough) {
    const HeightSamples samples{config.half_size_m + kOverhang,
                                std::min(kFinestRough, config.shortest_wave_m / 4.0),
                                [&terrain](double x, double y) { return terrain.At(x, y).h; }};
    return AddHeightfield(spec, world, "rough", samples, 0.0, "ground");
  }
  return AddGroundPlane(world, terrain.At(0.0, 0.0), 0.0, "ground");
}

/// To see by: the sun, half way up.
void AddSun(mjsBody* world) {
  mjsLight* sun = mjs_addLight(world, nullptr);
  sun->type = mjLIGHT_DIRECTIONAL;
  sun->castshadow = 0;  // one map of shadows over a whole field is too coarse for a robot
  const double dir[] = {0.5, 0.3, -0.8};
  std::copy(dir, dir + 3, sun->dir);
  for (float& part : sun->diffuse) part = 0.8F;
  for (float& part : sun->ambient) part = 0.3F;
  for (float& part : sun->specular) part = 0.1F;
}

}  // namespace

void SetGroundContact(const TerrainConfig& terrain, int priority, mjsGeom* geom) {
  const GroundContactConfig& contact = terrain.contact;
  SetHardContact(geom, terrain.friction);
  geom->priority = priority;
  geom->solref[0] = contact.time_constant_s;
  geom->solref[1] = contact.damping_ratio;
  geom->solimp[0] = contact.impedance_min;
  geom->solimp[1] = contact.impedance_max;
  geom->solimp[2] = contact.width_m;
}

double HighestOverTerrain(const TerrainConfig& terrain) {
  return terrain.kind == TerrainKind::kGravel ? terrain.stone_height_m : 0.0;
}

void AddWalkingGround(const Terrain& terrain, const std::vector<PatchConfig>& patches,
                      std::uint64_t seed, mjSpec* spec, mjsBody* world) {
  AddSky(spec, "sky", {0.45, 0.62, 0.80}, {0.80, 0.86, 0.90});
  AddChecker(spec, "ground", {0.52, 0.55, 0.50}, {0.46, 0.49, 0.45}, 0.5);
  AddSun(world);
  mjsGeom* base = AddBase(terrain, seed, spec, world);
  base->group = kSceneryGroup;
  SetGroundContact(terrain.config(), 1, base);
  if (terrain.config().kind == TerrainKind::kStairs) AddStairs(terrain.config(), world);
  if (terrain.config().kind == TerrainKind::kDebris) AddDebris(terrain.config(), seed, world);
  if (terrain.config().kind != TerrainKind::kFlat) return;
  for (const auto& [box, friction] : patches) {
    const Colour& colour = friction < terrain.config().friction ? kIce : kGrip;
    mjsGeom* drawn = AddBox({box[0], box[1], 0.0, {box[2] / 2, box[3] / 2, kThin}}, colour, world);
    drawn->contype = drawn->conaffinity = 0;
  }
}

}  // namespace reckon::sim
