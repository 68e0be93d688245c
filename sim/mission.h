#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/sim/range.h"
#include "reckon/sim/route.h"

namespace reckon::sim {

enum class MissionKind { kHover, kDive, kSquare, kLawnmower, kHelix, kWaypoints };

/// What an underwater vehicle is asked to do. It starts at x = y = 0, `start_depth_m` deep with its
/// bow along x, and goes down to `depth_m` first. Which other fields count depends on `kind`; at
/// the end it holds its place.
struct MissionConfig {
  MissionKind kind = MissionKind::kHover;
  double start_s = 1.0;  ///< it holds its place until then
  double start_depth_m = 1.0;
  double depth_m = 5.0;
  double speed_m_s = 0.5;    ///< over ground
  double hold_s = 10.0;      ///< dive: at depth, before it returns
  double side_m = 10.0;      ///< square
  double laps = 1.0;         ///< square
  double length_m = 20.0;    ///< lawnmower: of a track, along x
  double spacing_m = 4.0;    ///< lawnmower: from track to track, along y
  int tracks = 6;            ///< lawnmower
  double radius_m = 4.0;     ///< helix
  double turns = 3.0;        ///< helix
  double end_depth_m = 8.0;  ///< helix: of its last point
  bool clockwise = false;    ///< square, lawnmower, helix: to the right, seen from above
  std::vector<std::array<double, 3>> waypoints_m = {};  ///< [x, y, depth]

  static constexpr Range kDepth = AboveUpTo(0, 11000), kSpeed = AboveUpTo(0, 5);
  static constexpr Range kTime{0, 1e5}, kLength = AboveUpTo(0, 1000), kLaps = AboveUpTo(0, 1000);
  static constexpr Range kTracks{1, 1000};
};

/// A stretch of a mission, and how long the vehicle stays at its end.
struct Leg {
  Route route;
  double hold_s = 0.0;
};

/// The stretches of a mission, in order. Throws std::invalid_argument, which names the key, for
/// numbers out of range and a mission `waypoints` without points.
std::vector<Leg> LegsOf(const MissionConfig& mission);

/// What makes a mission impossible over a bottom that lies `depth_at(x, y)` deep: a point above the
/// surface or under the bottom, the first of them with its numbers; nothing if all is well.
/// `room_m` is what must stay free under the surface.
std::optional<std::string> MissionTrouble(const std::vector<Leg>& legs,
                                          const std::function<double(double, double)>& depth_at,
                                          double room_m);

}  // namespace reckon::sim
