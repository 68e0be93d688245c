#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace reckon::sim {

/// Height of the ground over the horizontal plane, and its slopes ∂h/∂x, ∂h/∂y.
struct Ground {
  double h = 0.0, hx = 0.0, hy = 0.0;
};

/// Smooth rough ground: a sum of cosines
///     h(x, y) = Σ_i a_i cos(k_i·(x, y) + φ_i),   |k_i| = 2π/λ_i,   a_i ∝ λ_i^0.8,   Σ a_i²/2 =
///     rms²
/// whose wavelengths fill [shortest, longest] evenly in log λ, with directions and phases drawn
/// from the seed. Tabulated every 0.1 m with its exact derivatives and interpolated by bicubic
/// Hermite patches, so that heights and slopes are continuous everywhere.
class TerrainTable {
 public:
  struct Waves {
    double rms_m = 0.0, shortest_m = 0.0, longest_m = 0.0;
  };

  /// Covers |x|, |y| ≤ `half_size_m`. Allocates 16 bytes for each node.
  TerrainTable(const Waves& waves, double half_size_m, std::uint64_t seed);

  /// Outside of the table the nearest edge cell is continued. Does not allocate.
  Ground At(double x, double y) const;

 private:
  int nodes_ = 0;  // a side
  double half_size_m_ = 0.0;
  // h, h_x d, h_y d, h_xy d² of each node, where d is the node spacing. Single precision halves the
  // memory; the interpolant stays exactly C1, since neighbouring cells share their nodes.
  std::vector<Eigen::Vector4f> node_;
};

}  // namespace reckon::sim
