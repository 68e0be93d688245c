#include "reckon/sim/mission.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr int kPiecesPerTurn = 72;
constexpr double kCheckEvery = 0.25;  // m

void Require(const Range& range, double value, const char* key) {
  RequireIn(range, value, "mission", key);
}

void Check(const MissionConfig& m) {
  Require(MissionConfig::kTime, m.start_s, "start_s");
  Require(MissionConfig::kTime, m.hold_s, "hold_s");
  Require(MissionConfig::kSpeed, m.speed_m_s, "speed_m_s");
  const std::pair<const char*, double> lengths[] = {{"side_m", m.side_m},
                                                    {"length_m", m.length_m},
                                                    {"spacing_m", m.spacing_m},
                                                    {"radius_m", m.radius_m}};
  for (const auto& [key, length] : lengths) Require(MissionConfig::kLength, length, key);
  Require(MissionConfig::kLaps, m.laps, "laps");
  Require(MissionConfig::kLaps, m.turns, "turns");
  Require(MissionConfig::kTracks, m.tracks, "tracks");
  const std::pair<const char*, double> depths[] = {
      {"start_depth_m", m.start_depth_m}, {"depth_m", m.depth_m}, {"end_depth_m", m.end_depth_m}};
  for (const auto& [key, depth] : depths) {
    if (!std::isfinite(depth)) Require(MissionConfig::kDepth, depth, key);
  }
  if (m.kind == MissionKind::kWaypoints && m.waypoints_m.empty()) {
    throw std::invalid_argument("mission: waypoints_m must hold at least one point [x, y, depth]");
  }
}

Points Square(const MissionConfig& m, double left) {
  const Vector3d corners[] = {
      {0, 0, 0}, {m.side_m, 0, 0}, {m.side_m, left * m.side_m, 0}, {0, left * m.side_m, 0}};
  Points points;
  const double sides = 4.0 * m.laps;
  for (int i = 0; i <= std::floor(sides); ++i) points.push_back(corners[i % 4]);
  const int last = static_cast<int>(std::floor(sides));
  const double rest = sides - last;
  points.push_back(corners[last % 4] + rest * (corners[(last + 1) % 4] - corners[last % 4]));
  return points;
}

Points Lawnmower(const MissionConfig& m, double left) {
  Points points;
  for (int i = 0; i < m.tracks; ++i) {
    const double y = left * i * m.spacing_m;
    const double from = i % 2 == 0 ? 0.0 : m.length_m;
    points.emplace_back(from, y, 0);
    points.emplace_back(m.length_m - from, y, 0);
  }
  return points;
}

Points Helix(const MissionConfig& m, double left) {
  Points points;
  const int pieces = std::max(1, static_cast<int>(std::ceil(kPiecesPerTurn * m.turns)));
  for (int i = 0; i <= pieces; ++i) {
    const double part = static_cast<double>(i) / pieces;
    const double angle = 2.0 * std::numbers::pi * m.turns * part;
    points.emplace_back(m.radius_m * std::sin(angle), left * m.radius_m * (1.0 - std::cos(angle)),
                        -(m.end_depth_m - m.depth_m) * part);
  }
  return points;
}

/// Points over the horizontal plane as points of a route at the mission's depth.
Route AtDepth(Points points, double depth) {
  for (Vector3d& point : points) point.z() -= depth;
  return Route(points);
}

Route Through(const MissionConfig& m) {
  Points points{{0, 0, -m.depth_m}};
  for (const auto& [x, y, depth] : m.waypoints_m) points.emplace_back(x, y, -depth);
  return Route(points);
}

}  // namespace

std::vector<Leg> LegsOf(const MissionConfig& m) {
  Check(m);
  const double left = m.clockwise ? -1.0 : 1.0;
  const Vector3d start(0, 0, -m.start_depth_m), deep(0, 0, -m.depth_m);
  std::vector<Leg> legs{{Route({start, deep}), 0.0}};
  switch (m.kind) {
    case MissionKind::kHover:
      break;
    case MissionKind::kDive:
      legs.front().hold_s = m.hold_s;
      legs.push_back({Route({deep, start}), 0.0});
      break;
    case MissionKind::kSquare:
      legs.push_back({AtDepth(Square(m, left), m.depth_m), 0.0});
      break;
    case MissionKind::kLawnmower:
      legs.push_back({AtDepth(Lawnmower(m, left), m.depth_m), 0.0});
      break;
    case MissionKind::kHelix:
      legs.push_back({AtDepth(Helix(m, left), m.depth_m), 0.0});
      break;
    case MissionKind::kWaypoints:
      legs.push_back({Through(m), 0.0});
      break;
  }
  return legs;
}

std::optional<std::string> MissionTrouble(const std::vector<Leg>& legs,
                                          const std::function<double(double, double)>& depth_at,
                                          double room_m) {
  for (const Leg& leg : legs) {
    const int pieces = static_cast<int>(std::ceil(leg.route.length() / kCheckEvery));
    for (int i = 0; i <= pieces; ++i) {
      const Vector3d p = leg.route.At(std::min(i * kCheckEvery, leg.route.length()));
      const double bottom = depth_at(p.x(), p.y());
      char text[200];
      if (!(-p.z() > room_m)) {
        std::snprintf(
            text, sizeof text,
            "it leads above the surface: %.3g m deep at x = %.3g m, y = %.3g m, where more "
            "than %.3g m keep the vehicle under water",
            -p.z(), p.x(), p.y(), room_m);
        return text;
      }
      if (!(-p.z() < bottom)) {
        std::snprintf(text, sizeof text,
                      "it leads under the seabed: %.3g m deep at x = %.3g m, y = %.3g m, where the "
                      "bottom lies %.3g m deep",
                      -p.z(), p.x(), p.y(), bottom);
        return text;
      }
    }
  }
  return std::nullopt;
}

}  // namespace reckon::sim
