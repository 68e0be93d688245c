#include "reckon/models/urdf_robot.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace reckon::models {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

std::string Robot(const std::string& body) { return "<robot name='r'>" + body + "</robot>"; }

const char kBase[] =
    "<link name='base'><inertial><mass value='2'/>"
    "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";

std::string Joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>";
}

/// The message of the exception that reading `body` throws.
std::string Refusal(const std::string& body) {
  try {
    UrdfRobot::FromText(Robot(body), "test.urdf");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

testing::AssertionResult Says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << message << "' does not say '" << part << "'";
}

TEST(UrdfRobot, ComposesFixedFrames) {
  // A frame 1 m ahead that looks left, and on it one 2 m ahead: that is 2 m to the left of the
  // first.
  const auto robot = UrdfRobot::FromText(Robot(
      std::string(kBase) + "<link name='a'/><link name='b'/>" +
      Joint("to_a", "fixed", "base", "a", "<origin xyz='1 0 0' rpy='0 0 1.57079632679489662'/>") +
      Joint("to_b", "fixed", "a", "b", "<origin xyz='2 0 0'/>")));
  const Pose X_Bb = robot.LinkPose("b");
  EXPECT_TRUE(X_Bb.p.isApprox(Eigen::Vector3d(1, 2, 0), 1e-15));
  EXPECT_TRUE(X_Bb.R.col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_FALSE(robot.links()[robot.LinkIndex("b")].inertial);
}

TEST(UrdfRobot, MovesJointsAboutTheirAxes) {
  const auto robot = UrdfRobot::FromText(Robot(
      std::string(kBase) + "<link name='arm'/><link name='rod'/><link name='tip'/>" +
      Joint("shoulder", "continuous", "base", "arm", "<origin xyz='0 0 1'/><axis xyz='0 2 0'/>") +
      Joint("slide", "prismatic", "arm", "rod",
            "<axis xyz='1 0 0'/><limit lower='0' upper='9' effort='1' velocity='1'/>") +
      Joint("end", "fixed", "rod", "tip", "<origin xyz='0.5 0 0'/>")));
  std::vector<double> q(robot.joints().size());
  q[robot.JointIndex("shoulder")] = kQuarter;  // +90° about y turns x downwards
  q[robot.JointIndex("slide")] = 0.25;
  const Pose X_BT = robot.LinkPose(robot.LinkIndex("tip"), q);
  EXPECT_TRUE(X_BT.p.isApprox(Eigen::Vector3d(0, 0, 1 - 0.75), 1e-15)) << X_BT.p.transpose();
  EXPECT_TRUE(robot.LinkPose("tip").p.isApprox(Eigen::Vector3d(0.5, 0, 1), 1e-15));
}

TEST(UrdfRobot, TurnsInertiaIntoTheLinksAxes) {
  const auto robot = UrdfRobot::FromText(
      Robot("<link name='base'><inertial><origin xyz='1 2 3' rpy='0 0 1.57079632679489662'/>"
            "<mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2.5'/>"
            "</inertial></link>"));
  const auto& inertial = *robot.links()[0].inertial;
  // A quarter turn about z swaps the moments about x and y.
  EXPECT_TRUE(
      inertial.I_C_L.isApprox(Eigen::Vector3d(2, 1, 2.5).asDiagonal().toDenseMatrix(), 1e-15));
  EXPECT_EQ(inertial.p_LC, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(robot.TotalMass(), 2.0);
}

TEST(UrdfRobot, NamesTheLinkThatHasGeometryButNoInertia) {
  const std::string wheel =
      "<link name='wheel'><visual><geometry><sphere radius='1'/></geometry></visual></link>";
  const auto message = Refusal(kBase + wheel + Joint("j", "continuous", "base", "wheel", ""));
  EXPECT_TRUE(Says(message, "link 'wheel' has geometry but no <inertial>"));
  EXPECT_TRUE(Says(message, "test.urdf"));
}

TEST(UrdfRobot, RefusesWhatNoBodyCanBe) {
  const auto link = [](const std::string& mass, const std::string& izz, const std::string& more) {
    return "<link name='base'><inertial><mass value='" + mass +
           "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='" + izz + "'/></inertial>" +
           more + "</link>";
  };
  const std::string box = "<collision><geometry><box size='1 -1 1'/></geometry></collision>";
  EXPECT_EQ(Refusal(link("1", "1", "")), "");
  EXPECT_TRUE(Says(Refusal(link("-1", "1", "")), "link 'base' has a mass that is not positive"));
  EXPECT_TRUE(Says(Refusal(link("1", "2.1", "")), "link 'base' has an inertia that no rigid body"));
  EXPECT_TRUE(Says(Refusal(link("1", "-1", "")), "link 'base' has an inertia that no rigid body"));
  EXPECT_TRUE(Says(Refusal(link("1", "1", box)), "link 'base' has a geometry whose size"));
}

TEST(UrdfRobot, RefusesLimitsTheWrongWayRound) {
  const std::string links = std::string(kBase) + "<link name='arm'/>";
  const auto with = [&](const std::string& limit) {
    return Refusal(links +
                   Joint("elbow", "revolute", "base", "arm", "<axis xyz='0 1 0'/>" + limit));
  };
  EXPECT_EQ(with("<limit lower='-1' upper='1' effort='1' velocity='1'/>"), "");
  EXPECT_TRUE(Says(with("<limit lower='1' upper='-1' effort='1' velocity='1'/>"),
                   "joint 'elbow' has a lower limit, 1.000000, that is not below its upper one"));
}

TEST(UrdfRobot, RefusesAClosedChain) {
  const std::string message = Refusal(
      std::string(kBase) + "<link name='a'/><link name='b'/><link name='foot'/>" +
      Joint("to_a", "continuous", "base", "a", "") + Joint("to_b", "continuous", "base", "b", "") +
      Joint("left", "continuous", "a", "foot", "") + Joint("right", "continuous", "b", "foot", ""));
  EXPECT_TRUE(Says(message, "link 'foot' is the child of more than one joint"));
}

TEST(UrdfRobot, NamesWhatIsMissing) {
  EXPECT_THROW(UrdfRobot::FromFile("/nonexistent/robot.urdf"), std::invalid_argument);
  const auto robot = UrdfRobot::FromText(Robot(kBase), "test.urdf");
  try {
    robot.LinkIndex("imu_link");
    FAIL() << "a link that does not exist was found";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(Says(error.what(), "test.urdf: there is no link 'imu_link'"));
  }
  EXPECT_THROW(robot.JointIndex("wheel"), std::invalid_argument);
}

TEST(UrdfRobot, RefusesTextThatIsNoRobot) {
  EXPECT_THROW(UrdfRobot::FromText(""), std::invalid_argument);
  EXPECT_THROW(UrdfRobot::FromText("<robot name='r'>"), std::invalid_argument);
  EXPECT_THROW(UrdfRobot::FromText("<mujoco/>"), std::invalid_argument);
  EXPECT_TRUE(Says(
      Refusal(std::string(kBase) + "<link name='a'/>" + Joint("j", "floating", "base", "a", "")),
      "joint 'j' is not fixed, revolute, continuous or prismatic"));
  EXPECT_TRUE(Says(
      Refusal(std::string(kBase) + "<link name='a'/>" + Joint("j", "fixed", "nowhere", "a", "")),
      "nowhere"));
}

}  // namespace
}  // namespace reckon::models
