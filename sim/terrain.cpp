#include "reckon/sim/terrain.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace reckon::sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kOverhang = 2.0;  // wheels reach beyond the map before the body leaves it [m]
constexpr double kLargestRoughMap = 150.0;  // a table of 9e6 nodes [m]
constexpr double kRoomToStart = 1.5;        // the robot stands between two kerbs [m]

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw std::invalid_argument("terrain: " + sentence);
}

bool Finite(double value, double low, double high) { return value >= low && value <= high; }

void CheckSlope(const TerrainConfig& config) {
  Require(Finite(config.angle_deg, -60.0, 60.0), "angle_deg must be within ±60");
  Require(std::isfinite(config.uphill_deg), "uphill_deg must be finite");
}

void CheckRough(const TerrainConfig& config) {
  Require(Finite(config.rms_m, 0.0, 1.0), "rms_m must be within 0 and 1");
  Require(Finite(config.shortest_wave_m, 0.4, 1e3), "shortest_wave_m must be at least 0.4");
  Require(Finite(config.longest_wave_m, config.shortest_wave_m, 1e3),
          "longest_wave_m must be at least shortest_wave_m");
  Require(config.half_size_m <= kLargestRoughMap,
          "half_size_m of rough ground must be at most 150");
}

void CheckKerbs(const TerrainConfig& config) {
  // The chassis has no contacts: a kerb that could meet it is refused.
  Require(Finite(config.kerb_height_m, 1e-3, 0.12), "kerb_height_m must be within 0.001 and 0.12");
  Require(Finite(config.kerb_width_m, 1e-2, 1e3), "kerb_width_m must be at least 0.01");
  Require(Finite(config.kerb_spacing_m, config.kerb_width_m + kRoomToStart, 1e6),
          "kerb_spacing_m must exceed kerb_width_m by at least 1.5, so that the robot can stand "
          "between two kerbs");
}

void Check(const TerrainConfig& config) {
  Require(Finite(config.friction, 0.0, 5.0), "friction must be within 0 and 5");
  Require(Finite(config.rolling_resistance, 0.0, 1.0), "rolling_resistance must be within 0 and 1");
  Require(Finite(config.half_size_m, 1.0, 1e5), "half_size_m must be at least 1");
  if (config.kind == TerrainKind::kSlope) CheckSlope(config);
  if (config.kind == TerrainKind::kRough) CheckRough(config);
  if (config.kind == TerrainKind::kKerbs) CheckKerbs(config);
}

}  // namespace

Terrain::Terrain(const TerrainConfig& config, const std::vector<PatchConfig>& patches,
                 std::uint64_t seed)
    : config_(config) {
  Check(config);
  for (const auto& [box, friction] : patches) {
    Require(std::isfinite(box[0]) && std::isfinite(box[1]), "a patch's centre must be finite");
    Require(box[2] > 0 && box[3] > 0, "a patch's sizes must be positive");
    Require(Finite(friction, 0.0, 5.0), "a patch's friction must be within 0 and 5");
    patches_.push_back({box[0] - box[2] / 2, box[0] + box[2] / 2, box[1] - box[3] / 2,
                        box[1] + box[3] / 2, friction});
  }
  if (config.kind == TerrainKind::kSlope) {
    const double rise = std::tan(config.angle_deg * kRadPerDeg);
    slope_ = {0.0, rise * std::cos(config.uphill_deg * kRadPerDeg),
              rise * std::sin(config.uphill_deg * kRadPerDeg)};
  }
  if (config.kind == TerrainKind::kRough) {
    rough_.emplace(TerrainTable::Waves{config.rms_m, config.shortest_wave_m, config.longest_wave_m},
                   config.half_size_m + kOverhang, seed);
  }
}

Ground Terrain::At(double x, double y) const {
  if (rough_) return rough_->At(x, y);
  return {slope_.hx * x + slope_.hy * y, slope_.hx, slope_.hy};
}

double Terrain::Friction(double x, double y) const {
  for (auto patch = patches_.rbegin(); patch != patches_.rend(); ++patch) {
    if (x >= patch->x_min && x <= patch->x_max && y >= patch->y_min && y <= patch->y_max) {
      return patch->friction;
    }
  }
  return config_.friction;
}

bool Terrain::Contains(double x, double y) const {
  return std::abs(x) <= config_.half_size_m && std::abs(y) <= config_.half_size_m;
}

std::array<std::optional<double>, 2> Terrain::KerbsAround(double x) const {
  std::array<std::optional<double>, 2> kerbs;
  const double below = std::floor(x / config_.kerb_spacing_m);
  for (int i = 0; i < 2; ++i) {
    const double centre = (below + i) * config_.kerb_spacing_m;
    if (centre != 0.0 && std::abs(centre) <= config_.half_size_m) kerbs[i] = centre;
  }
  return kerbs;
}

}  // namespace reckon::sim
