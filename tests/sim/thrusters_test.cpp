#include "reckon/sim/thrusters.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

/// Four vectored thrusters and four vertical ones.
std::vector<ThrusterConfig> Eight() {
  std::vector<ThrusterConfig> all;
  for (const double x : {0.156, -0.156}) {
    for (const double y : {0.111, -0.111}) {
      all.push_back({{x, y, -0.085}, Vector3d(1.0, x * y > 0 ? -1.0 : 1.0, 0.0), 40.0, 0.08});
    }
  }
  for (const double x : {0.12, -0.12}) {
    for (const double y : {0.218, -0.218})
      all.push_back({{x, y, 0}, Vector3d::UnitZ(), 40.0, 0.08});
  }
  return all;
}

Vector6 Wanted() {
  Vector6 wanted;
  wanted << 30, -10, 20, 0.5, -1.0, 2.0;
  return wanted;
}

TEST(Thrusters, GiveWhatIsWantedOnceTheyHaveSpunUp) {
  Thrusters thrusters("x", Eight());
  Vector6 given = Vector6::Zero();
  for (int i = 0; i < 1000; ++i) given = thrusters.Update(Wanted(), 0.01);
  EXPECT_LT((given - Wanted()).norm(), 1e-12);
  EXPECT_LT(thrusters.thrust_n().cwiseAbs().maxCoeff(), 40.0);
  EXPECT_FALSE(thrusters.saturated());
}

TEST(Thrusters, FollowWithTheirLagWhateverTheStep) {
  for (const int steps : {1, 10, 1000}) {
    Thrusters thrusters("x", Eight());
    Vector6 given = Vector6::Zero();
    for (int i = 0; i < steps; ++i) given = thrusters.Update(Wanted(), 0.08 / steps);
    EXPECT_LT((given - (1.0 - std::exp(-1.0)) * Wanted()).norm(), 1e-11) << steps;
  }
}

TEST(Thrusters, KeepTheDirectionWhereOneWouldBeTooStrong) {
  Thrusters thrusters("x", Eight());
  Vector6 given = Vector6::Zero();
  for (int i = 0; i < 1000; ++i) given = thrusters.Update(20.0 * Wanted(), 0.01);
  EXPECT_NEAR(thrusters.thrust_n().cwiseAbs().maxCoeff(), 40.0, 1e-9);
  EXPECT_LT((given.normalized() - Wanted().normalized()).norm(), 1e-12);
  EXPECT_TRUE(thrusters.saturated());
}

TEST(Thrusters, ComeNearestToWhatTheyCannotGive) {
  // Two at the stern: surge and yaw, nothing else.
  Thrusters thrusters("x", {{{-0.5, 0.2, 0}, Vector3d::UnitX(), 40.0, 0.0},
                            {{-0.5, -0.2, 0}, Vector3d::UnitX(), 40.0, 0.0}});
  Vector6 expected = Vector6::Zero();
  expected[0] = 30.0;
  expected[5] = 2.0;
  EXPECT_LT((thrusters.Update(Wanted(), 0.01) - expected).norm(), 1e-12);
}

std::string Complaint(const ThrusterConfig& thruster) {
  try {
    Thrusters("robot 'x'", {thruster});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Thrusters, RefuseWhatDoesNotPush) {
  EXPECT_EQ(Complaint({}), "");
  ThrusterConfig thruster;
  thruster.direction.setZero();
  EXPECT_EQ(Complaint(thruster), "robot 'x': a thruster's direction must have a length");
  thruster = {};
  thruster.limit_n = 0.0;
  EXPECT_EQ(Complaint(thruster), "robot 'x': a thruster's limit_n must be positive");
  thruster = {};
  thruster.lag_s = -1.0;
  EXPECT_EQ(Complaint(thruster), "robot 'x': a thruster's lag_s must not be negative");
  thruster = {};
  thruster.p_BT_m.x() = std::nan("");
  EXPECT_EQ(Complaint(thruster), "robot 'x': a thruster's place must be finite");
  EXPECT_THROW(Thrusters("x", {}), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::sim
