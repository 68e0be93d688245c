#include "reckon/sim/terrain_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/sim/random_stream.h"

namespace reckon::sim {
namespace {

constexpr double kSpacing = 0.1;
constexpr int kWaves = 64;

struct Wave {
  double amplitude = 0.0, kx = 0.0, ky = 0.0, phase = 0.0;
};

std::vector<Wave> DrawWaves(const TerrainTable::Waves& waves, std::uint64_t seed) {
  const RandomStream random(seed, "terrain");
  const double octaves = std::log(waves.longest_m / waves.shortest_m);
  std::vector<Wave> drawn(kWaves);
  double power = 0.0;
  for (int i = 0; i < kWaves; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const double place = (i + random.Uniform(0, index)) / kWaves;
    const double length = waves.shortest_m * std::exp(place * octaves);
    const double direction = 2.0 * std::numbers::pi * random.Uniform(1, index);
    const double k = 2.0 * std::numbers::pi / length;
    drawn[i] = {std::pow(length, 0.8), k * std::cos(direction), k * std::sin(direction),
                2.0 * std::numbers::pi * random.Uniform(2, index)};
    power += drawn[i].amplitude * drawn[i].amplitude / 2.0;
  }
  const double scale = waves.rms_m / std::sqrt(power);
  for (auto& wave : drawn) wave.amplitude *= scale;
  return drawn;
}

/// The factors of one coordinate: cos(k x + φ) and sin(k x + φ) of each wave (rows) at each node
/// (columns), and their derivatives over x times the spacing.
struct Factors {
  Eigen::MatrixXf value, slope;
};

/// `cosine_rows` c, s with c cos − s sin = cos of the sum of both coordinates' phases.
template <typename WaveNumber, typename Phase, typename Sign>
Factors MakeFactors(const std::vector<Wave>& waves, int nodes, double start, WaveNumber k,
                    Phase phase, Sign sine_sign) {
  Factors factors{Eigen::MatrixXf(2 * kWaves, nodes), Eigen::MatrixXf(2 * kWaves, nodes)};
  for (int j = 0; j < nodes; ++j) {
    const double x = start + kSpacing * j;
    for (int i = 0; i < kWaves; ++i) {
      const Wave& wave = waves[i];
      const double angle = k(wave) * x + phase(wave), rate = k(wave) * kSpacing;
      factors.value(2 * i, j) = static_cast<float>(std::cos(angle));
      factors.value(2 * i + 1, j) = static_cast<float>(sine_sign(wave) * std::sin(angle));
      factors.slope(2 * i, j) = static_cast<float>(-rate * std::sin(angle));
      factors.slope(2 * i + 1, j) = static_cast<float>(sine_sign(wave) * rate * std::cos(angle));
    }
  }
  return factors;
}

/// Cubic Hermite basis on [0, 1]: value (p) and slope (m) functions of both ends, with derivatives.
struct Hermite {
  double p[2], m[2], dp[2], dm[2];

  explicit Hermite(double t) {
    const double t2 = t * t, t3 = t2 * t;
    p[1] = 3 * t2 - 2 * t3;
    p[0] = 1 - p[1];
    m[0] = t3 - 2 * t2 + t;
    m[1] = t3 - t2;
    dp[1] = 6 * t - 6 * t2;
    dp[0] = -dp[1];
    dm[0] = 3 * t2 - 4 * t + 1;
    dm[1] = 3 * t2 - 2 * t;
  }
};

}  // namespace

TerrainTable::TerrainTable(const Waves& waves, double half_size_m, std::uint64_t seed)
    : nodes_(2 * static_cast<int>(std::ceil(half_size_m / kSpacing)) + 1),
      half_size_m_(kSpacing * (nodes_ - 1) / 2) {
  const auto drawn = DrawWaves(waves, seed);
  // cos(kx x + ky y + φ) = cos(kx x + φ) cos(ky y) − sin(kx x + φ) sin(ky y): the table is a
  // product of two thin matrices.
  auto along_x = MakeFactors(
      drawn, nodes_, -half_size_m_, [](const Wave& w) { return w.kx; },
      [](const Wave& w) { return w.phase; }, [](const Wave&) { return -1.0; });
  const auto along_y = MakeFactors(
      drawn, nodes_, -half_size_m_, [](const Wave& w) { return w.ky; },
      [](const Wave&) { return 0.0; }, [](const Wave&) { return 1.0; });
  for (int i = 0; i < 2 * kWaves; ++i) {
    const auto amplitude = static_cast<float>(drawn[i / 2].amplitude);
    along_x.value.row(i) *= amplitude;
    along_x.slope.row(i) *= amplitude;
  }
  node_.resize(static_cast<std::size_t>(nodes_) * nodes_);
  Eigen::Map<Eigen::MatrixXf> table(node_.front().data(), 4,
                                    static_cast<Eigen::Index>(node_.size()));
  for (int part = 0; part < 4; ++part) {
    const auto& fx = part & 1 ? along_x.slope : along_x.value;
    const auto& fy = part & 2 ? along_y.slope : along_y.value;
    const Eigen::MatrixXf heights = fx.transpose() * fy;  // (x node, y node)
    table.row(part) = heights.reshaped().transpose();
  }
}

Ground TerrainTable::At(double x, double y) const {
  const double u = (x + half_size_m_) / kSpacing, v = (y + half_size_m_) / kSpacing;
  const int i = std::clamp(static_cast<int>(u), 0, nodes_ - 2);
  const int j = std::clamp(static_cast<int>(v), 0, nodes_ - 2);
  const Hermite a(u - i), b(v - j);
  Ground ground;
  for (int n = 0; n < 2; ++n) {
    const Eigen::Vector4f* column = &node_[static_cast<std::size_t>(j + n) * nodes_ + i];
    double value = 0.0, slope = 0.0, dvalue = 0.0, dslope = 0.0;  // along x, of h and of h_y d
    for (int k = 0; k < 2; ++k) {
      const double h = column[k][0], hx = column[k][1], hy = column[k][2], hxy = column[k][3];
      value += a.p[k] * h + a.m[k] * hx;
      slope += a.p[k] * hy + a.m[k] * hxy;
      dvalue += a.dp[k] * h + a.dm[k] * hx;
      dslope += a.dp[k] * hy + a.dm[k] * hxy;
    }
    ground.h += b.p[n] * value + b.m[n] * slope;
    ground.hx += b.p[n] * dvalue + b.m[n] * dslope;
    ground.hy += b.dp[n] * value + b.dm[n] * slope;
  }
  ground.hx /= kSpacing;
  ground.hy /= kSpacing;
  return ground;
}

}  // namespace reckon::sim
