#include "reckon/sim/path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

constexpr double kPi = std::numbers::pi;

void ExpectAt(const Path& path, double s, double x, double y, double heading_rad) {
  const auto point = path.At(s);
  EXPECT_NEAR(point.p.x(), x, 1e-12) << "at s = " << s;
  EXPECT_NEAR(point.p.y(), y, 1e-12) << "at s = " << s;
  EXPECT_NEAR(std::remainder(point.heading_rad - heading_rad, 2 * kPi), 0.0, 1e-12)
      << "at s = " << s;
}

TEST(Path, SquareTurnsLeftAtItsCorners) {
  const Path path = Path::Square(10, false);
  EXPECT_EQ(path.length(), 40.0);
  ExpectAt(path, 3, 3, 0, 0);
  ExpectAt(path, 14, 10, 4, kPi / 2);
  ExpectAt(path, 25, 5, 10, kPi);
  ExpectAt(path, 38, 0, 2, -kPi / 2);
  ExpectAt(path, 43, 3, 0, 0);  // the second lap
  ExpectAt(Path::Square(10, true), 14, 10, -4, -kPi / 2);
}

TEST(Path, CircleStartsAlongX) {
  const Path path = Path::Circle(5, false);
  EXPECT_NEAR(path.length(), 10 * kPi, 1e-12);
  ExpectAt(path, 0, 0, 0, 0);
  ExpectAt(path, 2.5 * kPi, 5, 5, kPi / 2);
  ExpectAt(Path::Circle(5, true), 2.5 * kPi, 5, -5, -kPi / 2);
}

TEST(Path, FigureEightChangesSides) {
  const Path path = Path::FigureEight(2, false);
  EXPECT_NEAR(path.length(), 8 * kPi, 1e-12);
  ExpectAt(path, 2 * kPi, 0, 4, kPi);   // top of the left lobe
  ExpectAt(path, 6 * kPi, 0, -4, kPi);  // bottom of the right one
}

TEST(Path, WaypointsGoOnStraight) {
  const Path path = Path::Waypoints({{0, 0}, {3, 0}, {3, 0}, {3, 4}});
  EXPECT_FALSE(path.closed());
  EXPECT_EQ(path.length(), 7.0);
  ExpectAt(path, 5, 3, 2, kPi / 2);
  ExpectAt(path, 8, 3, 5, kPi / 2);
}

TEST(Path, RefusesNothingToFollow) {
  EXPECT_THROW(Path::Waypoints({}), std::invalid_argument);
  EXPECT_THROW(Path::Waypoints({{0, 0}}), std::invalid_argument);
  EXPECT_THROW(Path::Waypoints({{NAN, 0}}), std::invalid_argument);
  EXPECT_THROW(Path::Square(-1, false), std::invalid_argument);
  EXPECT_THROW(Path::Circle(0, false), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
