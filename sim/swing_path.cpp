#include "reckon/sim/swing_path.h"

#include <algorithm>

namespace reckon::sim {
namespace {

constexpr double kLevelShare = 0.95, kUpShare = 0.45;

struct Value {
  double x = 0.0, dx = 0.0, ddx = 0.0;
};

/// From 0 to 1 with speed and acceleration zero at both ends: 10 u³ − 15 u⁴ + 6 u⁵.
Value Quintic(double u) {
  if (u >= 1.0) return {1.0, 0.0, 0.0};
  const double u2 = u * u;
  return {u2 * u * (10.0 + u * (6.0 * u - 15.0)), 30.0 * u2 * (1.0 + u * (u - 2.0)),
          60.0 * u * (1.0 + u * (2.0 * u - 3.0))};
}

/// From `a` at rest to `b` with slope `slope` (of u), 0 ≤ u ≤ 1.
Value Hermite(double a, double b, double slope, double u) {
  const double d = b - a, c2 = 3.0 * d - slope, c3 = slope - 2.0 * d;
  return {a + u * u * (c2 + u * c3), u * (2.0 * c2 + 3.0 * u * c3), 2.0 * c2 + 6.0 * u * c3};
}

}  // namespace

SwingPoint SwingAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double s,
                   double duration_s, double lift_m, double touch_down_m_s) {
  SwingPoint point;
  const Value level = Quintic(std::min(s / kLevelShare, 1.0));
  const double level_rate = 1.0 / (kLevelShare * duration_s);
  const Eigen::Vector2d way = (to - from).head<2>();
  point.p.head<2>() = from.head<2>() + level.x * way;
  point.v.head<2>() = level.dx * level_rate * way;
  point.a.head<2>() = level.ddx * level_rate * level_rate * way;
  const double top = std::max(from.z(), to.z()) + lift_m;
  const bool rises = s < kUpShare;
  const double span_s = (rises ? kUpShare : 1.0 - kUpShare) * duration_s;
  Value up = rises ? Quintic(s / kUpShare)
                   : Hermite(top, to.z(), -touch_down_m_s * span_s,
                             std::min((s - kUpShare) / (1.0 - kUpShare), 1.0));
  if (rises)
    up = {from.z() + up.x * (top - from.z()), up.dx * (top - from.z()), up.ddx * (top - from.z())};
  point.p.z() = up.x;
  point.v.z() = up.dx / span_s;
  point.a.z() = up.ddx / (span_s * span_s);
  return point;
}

}  // namespace reckon::sim
