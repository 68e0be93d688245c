#include "reckon/sim/path.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace reckon::sim {
namespace {

constexpr double kPi = std::numbers::pi;

void RequirePositive(double value, const char* key) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string("motion: ") + key + " must be positive");
  }
}

}  // namespace

Path Path::Square(double side_m, bool clockwise) {
  RequirePositive(side_m, "side_m");
  const double turn = clockwise ? -1.0 : 1.0;
  const Eigen::Vector2d corners[] = {
      {0, 0}, {side_m, 0}, {side_m, turn * side_m}, {0, turn * side_m}};
  Path path(true);
  for (int i = 0; i < 4; ++i) path.AddLine({corners[i], turn * i * kPi / 2}, side_m);
  return path;
}

Path Path::Circle(double radius_m, bool clockwise) {
  RequirePositive(radius_m, "radius_m");
  Path path(true);
  path.Add({{}, 2 * kPi * radius_m, (clockwise ? -1.0 : 1.0) / radius_m});
  return path;
}

Path Path::FigureEight(double radius_m, bool clockwise) {
  RequirePositive(radius_m, "radius_m");
  Path path(true);
  const double first = (clockwise ? -1.0 : 1.0) / radius_m;
  path.Add({{}, 2 * kPi * radius_m, first});
  path.Add({{}, 2 * kPi * radius_m, -first});
  return path;
}

Path Path::Waypoints(const std::vector<std::array<double, 2>>& points) {
  Path path(false);
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  for (const auto& point : points) {
    const Eigen::Vector2d to(point[0], point[1]);
    if (!to.allFinite()) throw std::invalid_argument("motion: waypoints_m must be finite");
    const Eigen::Vector2d step = to - from;
    if (step.norm() < 1e-9) continue;
    path.AddLine({from, std::atan2(step.y(), step.x())}, step.norm());
    from = to;
  }
  if (path.segments_.empty()) {
    throw std::invalid_argument("motion: waypoints_m must hold a point other than the origin");
  }
  return path;
}

void Path::Add(const Segment& segment) {
  segments_.push_back(segment);
  length_ += segment.length;
}

Path::Point Path::Along(const Segment& segment, double s) {
  const auto& [p, heading] = segment.start;
  if (segment.curvature == 0.0) {
    return {p + s * Eigen::Vector2d(std::cos(heading), std::sin(heading)), heading};
  }
  const double end = heading + segment.curvature * s, radius = 1.0 / segment.curvature;
  return {p + radius * Eigen::Vector2d(std::sin(end) - std::sin(heading),
                                       std::cos(heading) - std::cos(end)),
          end};
}

Path::Point Path::At(double s) const {
  assert(s >= 0);
  if (closed_) s = std::fmod(s, length_);
  for (std::size_t i = 0; i + 1 < segments_.size(); ++i) {
    if (s < segments_[i].length) return Along(segments_[i], s);
    s -= segments_[i].length;
  }
  return Along(segments_.back(), s);
}

}  // namespace reckon::sim
