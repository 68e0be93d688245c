#pragma once

#include <array>
#include <vector>

#include "reckon/sim/current.h"
#include "reckon/sim/range.h"

namespace reckon::sim {

enum class FeatureKind { kBoulder, kBlock, kPipe };

/// A thing on the seabed. Its sizes are along its own x, its y and up.
struct FeatureConfig {
  FeatureKind kind = FeatureKind::kBoulder;
  std::array<double, 2> at_m{0, 0};
  std::array<double, 3> size_m{1, 1, 1};  ///< a boulder's lower half lies in the ground
  double yaw_deg = 0.0;

  static constexpr Range kAt{-1e4, 1e4}, kSize = AboveUpTo(0, 100), kYaw{-360, 360};
};

/// The sea: its surface is z = 0 of W, and its bottom has the form of the world's terrain.
struct WaterConfig {
  double density_kg_m3 = 1025.0;
  double sound_speed_m_s = 1500.0;
  double depth_m = 10.0;  ///< of the bottom at x = y = 0 (rough bottoms: of their mean)
  CurrentConfig current;
  std::vector<FeatureConfig> features;

  static constexpr Range kDensity{900, 1100}, kSoundSpeed{1300, 1700};
  static constexpr Range kDepth = AboveUpTo(0, 11000);
};

}  // namespace reckon::sim
