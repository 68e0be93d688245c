#include "reckon/sim/current.h"

#include <algorithm>
#include <cmath>

namespace reckon::sim {

using Eigen::Vector3d;

Current::Current(const CurrentConfig& config, std::uint64_t seed)
    : config_(config), draws_(seed, "current"), kept_(std::exp(-1.0 / config.time_constant_s)) {
  for (int i = 0; i < 3; ++i) {
    RequireIn(CurrentConfig::kSpeed, config.mean_m_s[i], "current", "mean_m_s");
  }
  RequireIn(CurrentConfig::kSigma, config.sigma_m_s, "current", "sigma_m_s");
  RequireIn(CurrentConfig::kTimeConstant, config.time_constant_s, "current", "time_constant_s");
  for (int i = 0; i < 4; ++i) NextKnot();
}

void Current::NextKnot() {
  const bool first = drawn_ == 0;
  Vector3d next = first ? Vector3d::Zero() : Vector3d(kept_ * knots_.back());
  const double sigma = first ? config_.sigma_m_s : config_.sigma_m_s * std::sqrt(1 - kept_ * kept_);
  for (std::uint32_t axis = 0; axis < 3; ++axis) next[axis] += sigma * draws_.Normal(axis, drawn_);
  std::rotate(knots_.begin(), knots_.begin() + 1, knots_.end());
  knots_.back() = next;
  ++drawn_;
}

WaterMotion Current::At(double t_s) {
  for (; t_s >= static_cast<double>(second_ + 1); ++second_) NextKnot();
  const double u = t_s - static_cast<double>(second_);
  const Vector3d &a = knots_[1], &b = knots_[2];
  const Vector3d slope_a = (b - knots_[0]) / 2, slope_b = (knots_[3] - a) / 2;
  const Vector3d c = 3 * (b - a) - 2 * slope_a - slope_b, d = slope_a + slope_b - 2 * (b - a);
  return {config_.mean_m_s + a + u * (slope_a + u * (c + u * d)),
          slope_a + u * (2 * c + 3 * u * d)};
}

}  // namespace reckon::sim
