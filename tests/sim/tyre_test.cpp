#include "reckon/sim/tyre.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

const TyreParameters kTyre{0.1651, 25e3, 60.0, 0.05, 32e3, 500.0, 0.015};
constexpr double kDt = 0.001;
constexpr double kLoad = 138.0;  // a quarter of the robot, N

/// A wheel that rolls along +x with its centre at (0, 0, z).
WheelMotion Wheel(double z, const Eigen::Vector3d& velocity, double spin_rad_s) {
  return {
      {0, 0, z}, velocity, Eigen::Vector3d(0, spin_rad_s, 0), Eigen::Vector3d::UnitY(), spin_rad_s};
}

WheelContact Contact(double depth = 0.0) {
  return {Eigen::Vector3d::UnitZ(), {0, 0, depth / 3.0 - depth}, kLoad};
}

TEST(Tyre, CarriesItsLoadAsASpringAndDamper) {
  const Terrain flat({}, {}, 1);
  const double depth = 0.004;
  const auto still = SmoothContact(flat, kTyre, Wheel(kTyre.radius_m - depth, {0, 0, 0}, 0));
  EXPECT_NEAR(still.load_n, 32e3 * depth, 1e-9);
  EXPECT_NEAR(still.point.z(), -depth + depth / 3, 1e-12);  // the radius that rolls is R − δ/3
  const auto falling = SmoothContact(flat, kTyre, Wheel(kTyre.radius_m - depth, {1, 0, -0.1}, 0));
  EXPECT_NEAR(falling.load_n, 32e3 * depth + 500 * 0.1, 1e-9);
  const auto leaving = SmoothContact(flat, kTyre, Wheel(kTyre.radius_m - depth, {0, 0, 1}, 0));
  EXPECT_EQ(leaving.load_n, 0.0);  // the ground never pulls
  EXPECT_EQ(SmoothContact(flat, kTyre, Wheel(0.17, {0, 0, 0}, 0)).load_n, 0.0);
}

TEST(Tyre, FindsTheClosestGroundOfASlope) {
  TerrainConfig config;
  config.kind = TerrainKind::kSlope;
  config.angle_deg = 35.0;
  const Terrain slope(config, {}, 1);
  const double angle = 35.0 * std::numbers::pi / 180.0, depth = 0.003;
  const Eigen::Vector3d n(-std::sin(angle), 0, std::cos(angle));
  WheelMotion wheel = Wheel(0, {0, 0, 0}, 0);
  wheel.centre = (kTyre.radius_m - depth) * n;  // touches at the origin
  const auto contact = SmoothContact(slope, kTyre, wheel);
  EXPECT_NEAR(contact.load_n, 32e3 * depth, 1e-9);  // on a plane the depth is exact
  EXPECT_LT((contact.normal - n).norm(), 1e-12);
}

TEST(Tyre, SlidesWithCoulombFriction) {
  Tyre tyre;
  TyreForce force;
  // A locked wheel dragged along (3, 4)/5: the force opposes the slip, its size is μN.
  for (int i = 0; i < 500; ++i)
    force = tyre.Update(kTyre, Wheel(0.16, {0.3, 0.4, 0}, 0), Contact(), 0.8, kDt);
  EXPECT_NEAR(force.force.norm(), 0.8 * kLoad, 1e-9);
  EXPECT_LT((force.force / force.force.norm() - Eigen::Vector3d(-0.6, -0.8, 0)).norm(), 1e-6);
  EXPECT_NEAR(force.slip_m_s, 0.5, 1e-12);
}

TEST(Tyre, NeverExceedsTheConeWhileTheSlipTurns) {
  Tyre tyre;
  for (int i = 0; i < 2000; ++i) {
    const double a = 0.05 * i;
    const auto force = tyre.Update(kTyre, Wheel(0.16, {2 * std::cos(a), std::sin(a), 0}, 3.0),
                                   Contact(), 0.5, kDt);
    ASSERT_LE(force.force.norm(), 0.5 * kLoad * (1 + 1e-12));
  }
}

TEST(Tyre, HoldsAParkedWheelAsASpring) {
  Tyre tyre;
  // Dragged by 1 mm, then still: k · 1 mm = 25 N, below μN = 110 N, and it stays.
  for (int i = 0; i < 100; ++i)
    tyre.Update(kTyre, Wheel(0.16, {0, 0.01, 0}, 0), Contact(), 0.8, kDt);
  TyreForce force;
  for (int i = 0; i < 10000; ++i)
    force = tyre.Update(kTyre, Wheel(0.16, {0, 0, 0}, 0), Contact(), 0.8, kDt);
  EXPECT_NEAR(force.force.y(), -25.0, 1e-9);
}

TEST(Tyre, RollingForgetsTheBristle) {
  // Steady rolling at ω with lateral slip v_y: z = v_y σ/(|ω| R), so F_y = −(k σ/(|ω| R) + c) v_y.
  Tyre tyre;
  const double spin = 4.0, drift = 0.01;
  TyreForce force;
  for (int i = 0; i < 5000; ++i) {
    force = tyre.Update(kTyre, Wheel(0, {spin * kTyre.radius_m, drift, 0}, spin),
                        {Eigen::Vector3d::UnitZ(), {0, 0, -kTyre.radius_m}, kLoad}, 0.8, kDt);
  }
  const double expected = -(25e3 * 0.05 / (spin * kTyre.radius_m) + 60.0) * drift;
  // F is taken after the bristle has moved by one step: exact up to round-off.
  EXPECT_NEAR(force.force.y(), expected, 1e-9);
  EXPECT_NEAR(force.force.x(), 0.0, 1e-9);  // it rolls without slip
}

TEST(Tyre, ResistsRolling) {
  Tyre tyre;
  const auto force = tyre.Update(kTyre, Wheel(0.16, {0.8, 0, 0}, 5.0), Contact(), 0.8, kDt);
  EXPECT_NEAR(force.spin_torque_n_m, -0.015 * kLoad * 0.1651, 1e-9);  // tanh(25) is 1
}

TEST(Tyre, ForgetsEverythingInTheAir) {
  Tyre tyre;
  tyre.Update(kTyre, Wheel(0.16, {0, 0.5, 0}, 0), Contact(), 0.8, kDt);
  EXPECT_GT(tyre.bristle().norm(), 0.0);
  const auto force = tyre.Update(kTyre, Wheel(0.3, {0, 0.5, 0}, 0), {}, 0.8, kDt);
  EXPECT_EQ(force.force.norm(), 0.0);
  EXPECT_EQ(force.slip_m_s, 0.0);
  EXPECT_EQ(tyre.bristle().norm(), 0.0);
}

}  // namespace
}  // namespace reckon::sim
