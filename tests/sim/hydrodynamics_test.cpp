// A body in water against integrations and formulas that share no code with the simulation.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sim/basin.h"
#include "sim/kirchhoff.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using testing_sim::Basin;
using testing_sim::BodyInWater;
using testing_sim::kG;
using testing_sim::Kirchhoff;
using testing_sim::Neutral;
using testing_sim::Rov;

/// Everything at once: an added mass with all its entries, the centre of mass off the origin.
BodyInWater Awkward() {
  BodyInWater body = Rov();
  body.p_BG_m = {0.02, -0.01, -0.03};
  body.water.p_BV_m = {0.01, 0.005, 0.03};
  Matrix6 mixed = Matrix6::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) mixed(i, j) = 0.05 * std::cos(3.0 * i + 5.0 * j);
  }
  body.water.added_mass = (mixed * body.water.added_mass * mixed.transpose()).eval();
  return body;
}

Vector6 Thrust(double t) {
  Vector6 f;
  f << 20 + 10 * std::sin(0.5 * t), 8 * std::sin(0.7 * t), -5 * std::cos(0.4 * t),
      0.3 * std::sin(1.1 * t), 0.2 * std::cos(0.9 * t), 1.5 * std::sin(0.3 * t);
  return f;
}

WaterMotion Current(double t) {
  return {{0.1 + 0.05 * std::sin(0.2 * t), 0.05, 0.02 * std::cos(0.1 * t)},
          {0.01 * std::cos(0.2 * t), 0.0, -0.002 * std::sin(0.1 * t)}};
}

constexpr double kRun = 60.0;

models::Pose Reference() {
  static const models::Pose pose = [] {
    Kirchhoff reference(Awkward(), Thrust, Current);
    reference.Run(kRun, 1e-3);
    return reference.Pose();
  }();
  return pose;
}

/// The error of position after a minute [m].
double ErrorOf(double step_s, void (Basin::*step)()) {
  Basin basin(Awkward(), step_s);
  basin.thrust = Thrust;
  basin.water = Current;
  const long steps = std::lround(kRun / step_s);
  for (long i = 0; i < steps; ++i) (basin.*step)();
  return (basin.Pose().p - Reference().p).norm();
}

TEST(Hydrodynamics, FollowKirchhoffsEquations) {
  EXPECT_GT(Reference().p.norm(), 5.0) << "it does go somewhere";
  const double euler = ErrorOf(1e-3, &Basin::Step), finer = ErrorOf(5e-4, &Basin::Step);
  const double rk4 = ErrorOf(2e-3, &Basin::StepRk4), rk4_finer = ErrorOf(1e-3, &Basin::StepRk4);
  // Measured on a path of 10 m: 2.2 mm and 1.5 um (0.4 um at 1 ms). Euler is of first order, RK4
  // of second, since MuJoCo composes the rotation of a whole step.
  EXPECT_LT(euler, 4e-3);
  EXPECT_NEAR(euler / finer, 2.0, 0.1);
  EXPECT_LT(rk4, 3e-6);
  EXPECT_NEAR(rk4 / rk4_finer, 4.0, 0.4);
}

TEST(Hydrodynamics, AreMissedWithoutTheCurrentsOwnAcceleration) {
  // Negative control of the comparison above.
  Basin basin(Awkward());
  basin.thrust = Thrust;
  basin.water = [](double t) { return WaterMotion{Current(t).velocity_m_s, Vector3d::Zero()}; };
  for (int i = 0; i < 60000; ++i) basin.Step();
  EXPECT_GT((basin.Pose().p - Reference().p).norm(), 0.02);
}

TEST(Hydrodynamics, LetItRiseAtItsTerminalVelocity) {
  const BodyInWater rov = Rov();
  Basin basin(rov);
  for (int i = 0; i < 60000; ++i) basin.Step();
  const double excess = kG * (rov.density_kg_m3 * rov.water.volume_m3 - rov.mass_kg);
  const double linear = rov.water.linear_damping[2], square = rov.water.quadratic_damping[2];
  // The root of a v^2 + b v = excess, without cancellation.
  const double v = 2 * excess / (linear + std::sqrt(linear * linear + 4 * square * excess));
  EXPECT_NEAR(basin.Twist()[2], v, 1e-13);
}

TEST(Hydrodynamics, LetItPitchWithThePeriodOfAPendulum) {
  BodyInWater body = Neutral(Rov());
  body.water.linear_damping.setZero();
  body.water.quadratic_damping.setZero();
  Basin basin(body);
  const double amplitude = 2.0 * std::numbers::pi / 180;
  basin.data().qpos[3] = std::cos(amplitude / 2);
  basin.data().qpos[5] = std::sin(amplitude / 2);
  double before = 0.0, period = 0.0, first = 0.0;
  int crossings = 0;
  while (crossings < 11) {
    basin.StepRk4();
    const double pitch = -basin.Pose().R(2, 0), t = basin.data().time;
    if (before * pitch < 0.0) {
      const double at = t - 1e-3 * pitch / (pitch - before);
      if (crossings++ == 0) first = at;
      period = (at - first) / 5.0;
    }
    before = pitch;
  }
  const double lever = body.water.p_BV_m.z() - body.p_BG_m.z();
  const double inertia = body.inertia_kg_m2.y() + body.water.added_mass(4, 4);
  const double small = 2 * std::numbers::pi * std::sqrt(inertia / (body.mass_kg * kG * lever));
  // The first term of a pendulum's amplitude; the next is 5e-9. Crossings are interpolated to 1e-8.
  EXPECT_NEAR(period, small * (1 + amplitude * amplitude / 16), 1e-6);
}

/// By how much the energy of an undamped tumble changes in a minute, relative.
double EnergyGained(double step_s, void (Basin::*step)()) {
  BodyInWater body = Neutral(Awkward());
  body.water.linear_damping.setZero();
  body.water.quadratic_damping.setZero();
  Basin basin(body, step_s);
  Vector6 twist;
  twist << 0.5, -0.3, 0.2, 0.3, -0.2, 0.4;
  basin.SetTwist(twist);
  // Of body and added mass, and of weight and buoyancy, which pull at different points.
  const auto energy = [&] {
    const Vector6 v = basin.Twist();
    const Vector3d w = v.tail<3>(), v_G = v.head<3>() + w.cross(body.p_BG_m);
    const double kinetic =
        0.5 * (body.mass_kg * v_G.squaredNorm() + w.dot(body.inertia_kg_m2.cwiseProduct(w)) +
               v.dot(body.water.added_mass * v));
    const Vector3d pull = body.p_BG_m - body.water.p_BV_m;
    return kinetic + body.mass_kg * kG * (basin.Pose().R * pull).z();
  };
  const double start = energy();
  const long steps = std::lround(kRun / step_s);
  for (long i = 0; i < steps; ++i) (basin.*step)();
  return std::abs(energy() / start - 1.0);
}

TEST(Hydrodynamics, KeepTheEnergyWithoutDamping) {
  // 9e-7 at 1 ms, of second order; Euler gains.
  EXPECT_LT(EnergyGained(1e-3, &Basin::StepRk4), 2e-6);
  EXPECT_LT(EnergyGained(5e-4, &Basin::StepRk4), 5e-7);
  EXPECT_GT(EnergyGained(1e-3, &Basin::Step), 1e-3);
}

TEST(Hydrodynamics, TurnItAcrossTheFlow) {
  // Munk: a slender body ahead in a flow from aside turns broadside on.
  BodyInWater body = Rov();
  body.water.linear_damping.setZero();
  body.water.quadratic_damping.setZero();
  Basin basin(body);
  Vector6 twist = Vector6::Zero();
  twist.head<2>() << 1.0, 0.02;
  basin.SetTwist(twist);
  const double expected = -(7.12 - 6.36) * 1.0 * 0.02 / (0.37 + 0.222);
  EXPECT_NEAR(basin.Acceleration()[5], expected, 1e-12);
  EXPECT_NEAR(expected, -0.0257, 5e-5);
}

TEST(Hydrodynamics, LetItRestOnTheBottomWithWhatTheWaterDoesNotCarry) {
  BodyInWater body = Rov();
  body.mass_kg = 16.0;  // ballasted: it sinks
  Basin basin(body, 1e-3, -0.5);
  for (int i = 0; i < 20000; ++i) basin.Step();
  double load = 0.0;
  for (int i = 0; i < basin.data().ncon; ++i) {
    std::array<double, 6> force{};
    mj_contactForce(&basin.model(), &basin.data(), i, force.data());
    load += force[0];
  }
  const double expected = kG * (body.mass_kg - body.density_kg_m3 * body.water.volume_m3);
  EXPECT_LT(basin.Twist().norm(), 1e-6);
  EXPECT_NEAR(load, expected, 1e-6 * expected);
}

/// What the constructor says of a configuration; empty if it takes it.
std::string Complaint(const HydrodynamicsConfig& config, double density = 1025.0) {
  try {
    Hydrodynamics("robot 'x'", config, density, kG);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Hydrodynamics, RefuseWhatNoWaterDoes) {
  EXPECT_EQ(Complaint(Rov().water), "");
  HydrodynamicsConfig c = Rov().water;
  c.added_mass(0, 1) = 1.0;
  EXPECT_EQ(Complaint(c), "robot 'x': added_mass must be symmetric");
  c.added_mass(1, 0) = 1.0;
  EXPECT_EQ(Complaint(c), "");
  c.added_mass(1, 0) = c.added_mass(0, 1) = 10.0;
  EXPECT_EQ(Complaint(c), "robot 'x': added_mass must have no negative eigenvalue");
  c = Rov().water;
  c.added_mass(2, 2) = -1.0;
  EXPECT_EQ(Complaint(c), "robot 'x': added_mass must have no negative eigenvalue");
  c.added_mass(2, 2) = std::nan("");
  EXPECT_EQ(Complaint(c), "robot 'x': added_mass must be finite");
  c = Rov().water;
  c.quadratic_damping[3] = -1e-9;
  EXPECT_EQ(Complaint(c), "robot 'x': quadratic_damping must not be negative");
  c = Rov().water;
  c.volume_m3 = -1.0;
  EXPECT_EQ(Complaint(c), "robot 'x': volume_m3 must not be negative");
  EXPECT_EQ(Complaint(Rov().water, 0.0), "robot 'x': the water's density must be positive");
}

TEST(SubmergedBody, NeedsItsWholeBlockOfTheMassMatrix) {
  BodyInWater body = Rov();
  body.p_BG_m.setZero();
  EXPECT_THROW(Basin{body}, std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
