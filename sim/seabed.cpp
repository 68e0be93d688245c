#include "reckon/sim/seabed.h"

#include <stdexcept>

namespace reckon::sim {
namespace {

const WaterConfig& Checked(const WorldConfig& config) {
  if (!config.water) throw std::invalid_argument("world: there is no water");
  if (config.terrain.kind == TerrainKind::kKerbs) {
    throw std::invalid_argument("terrain: a seabed is flat, slope or rough");
  }
  const WaterConfig& water = *config.water;
  RequireIn(WaterConfig::kDensity, water.density_kg_m3, "water", "density_kg_m3");
  RequireIn(WaterConfig::kSoundSpeed, water.sound_speed_m_s, "water", "sound_speed_m_s");
  RequireIn(WaterConfig::kDepth, water.depth_m, "water", "depth_m");
  for (const FeatureConfig& feature : water.features) {
    for (const double at : feature.at_m)
      RequireIn(FeatureConfig::kAt, at, "water", "a feature's at_m");
    for (const double size : feature.size_m) {
      RequireIn(FeatureConfig::kSize, size, "water", "a feature's size_m");
    }
    RequireIn(FeatureConfig::kYaw, feature.yaw_deg, "water", "a feature's yaw_deg");
  }
  return water;
}

}  // namespace

Seabed::Seabed(const WorldConfig& config, std::uint64_t seed)
    : water_(Checked(config)), terrain_(config.terrain, {}, seed) {}

}  // namespace reckon::sim
