#include "reckon/sim/terrain.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

namespace reckon::sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kOverhang = 2.0;  // wheels reach beyond the map before the body leaves it [m]

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw std::invalid_argument("terrain: " + sentence);
}

void RequireIn(const Range& range, double value, const char* key) {
  RequireIn(range, value, "terrain", key);
}

void CheckRough(const TerrainConfig& config) {
  RequireIn(TerrainConfig::kRoughHalfSize, config.half_size_m, "half_size_m of rough ground");
  RequireIn(TerrainConfig::kRms, config.rms_m, "rms_m");
  RequireIn(TerrainConfig::kWave, config.shortest_wave_m, "shortest_wave_m");
  RequireIn(TerrainConfig::kWave, config.longest_wave_m, "longest_wave_m");
  Require(config.shortest_wave_m <= config.longest_wave_m,
          "longest_wave_m must be at least shortest_wave_m");
}

void CheckKerbs(const TerrainConfig& config) {
  RequireIn(TerrainConfig::kKerbHeight, config.kerb_height_m, "kerb_height_m");
  RequireIn(TerrainConfig::kKerbWidth, config.kerb_width_m, "kerb_width_m");
  RequireIn(TerrainConfig::kKerbSpacing, config.kerb_spacing_m, "kerb_spacing_m");
  Require(config.kerb_spacing_m >= config.LeastKerbSpacing(),
          "kerb_spacing_m must exceed kerb_width_m by at least 1.5, so that the robot can stand "
          "between two kerbs");
}

void Check(const TerrainConfig& config) {
  RequireIn(TerrainConfig::kFriction, config.friction, "friction");
  RequireIn(TerrainConfig::kRollingResistance, config.rolling_resistance, "rolling_resistance");
  RequireIn(TerrainConfig::kHalfSize, config.half_size_m, "half_size_m");
  if (config.kind == TerrainKind::kSlope) {
    RequireIn(TerrainConfig::kAngle, config.angle_deg, "angle_deg");
    RequireIn(TerrainConfig::kUphill, config.uphill_deg, "uphill_deg");
  }
  if (config.kind == TerrainKind::kRough) CheckRough(config);
  if (config.kind == TerrainKind::kKerbs) CheckKerbs(config);
}

}  // namespace

Terrain::Terrain(const TerrainConfig& config, const std::vector<PatchConfig>& patches,
                 std::uint64_t seed)
    : config_(config) {
  Check(config);
  for (const auto& [box, friction] : patches) {
    for (const double value : box) RequireIn(PatchConfig::kBox, value, "a patch's box_m");
    Require(box[2] > 0 && box[3] > 0, "a patch's sizes must be positive");
    RequireIn(TerrainConfig::kFriction, friction, "a patch's friction");
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

std::optional<std::string> Terrain::Outside(double x, double y) const {
  if (Contains(x, y)) return std::nullopt;
  char text[120];
  std::snprintf(text, sizeof(text), "the robot left the map (|x|, |y| ≤ %g m)",
                config_.half_size_m);
  return text;
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
