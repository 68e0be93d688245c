#pragma once

#include <cstdint>

#include "reckon/sim/terrain.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// The bottom of the sea: the world's terrain, `depth_m` under the surface, with what lies on it.
class Seabed {
 public:
  /// Throws std::invalid_argument, which names the key, for numbers out of range and kerbs.
  Seabed(const WorldConfig& config, std::uint64_t seed);

  const Terrain& terrain() const { return terrain_; }
  const std::vector<FeatureConfig>& features() const { return water_.features; }

  /// Of the bottom; on a slope at x = y = 0.
  double mean_depth_m() const { return water_.depth_m; }

  /// How deep the bottom lies at (x, y), without what lies on it. Does not allocate.
  double Depth(double x, double y) const { return water_.depth_m - terrain_.At(x, y).h; }

 private:
  WaterConfig water_;
  Terrain terrain_;
};

}  // namespace reckon::sim
