#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/sim/terrain_table.h"
#include "reckon/sim/world_config.h"

namespace reckon::sim {

/// The ground that wheels roll on: smooth heights h(x, y) and a friction map. For kerbs the heights
/// are those of the plane that the kerbs stand on; the kerbs themselves are boxes of the physics.
class Terrain {
 public:
  /// Throws std::invalid_argument, which names the key, for sizes, angles or friction values out of
  /// range. Rough ground is drawn from the seed and costs some 0.1 s.
  Terrain(const TerrainConfig& config, const std::vector<PatchConfig>& patches, std::uint64_t seed);

  const TerrainConfig& config() const { return config_; }

  /// Height and slopes under (x, y). Does not allocate.
  Ground At(double x, double y) const;

  /// Friction coefficient at (x, y): that of the last patch that covers the point, or the ground's.
  double Friction(double x, double y) const;

  /// Whether (x, y) is on the map.
  bool Contains(double x, double y) const;

  /// What a run that left the map ends with; nothing on it.
  std::optional<std::string> Outside(double x, double y) const;

  /// Centres along x [m] of the kerbs on both sides of `x`; nothing at the origin, where the robot
  /// starts, and beyond the map. Does not allocate.
  std::array<std::optional<double>, 2> KerbsAround(double x) const;

 private:
  struct Patch {
    double x_min, x_max, y_min, y_max, friction;
  };

  TerrainConfig config_;
  std::vector<Patch> patches_;
  Ground slope_;  // at the origin: h is 0
  std::optional<TerrainTable> rough_;
};

}  // namespace reckon::sim
