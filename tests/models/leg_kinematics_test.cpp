#include "reckon/models/leg_kinematics.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "models/allocations.h"

namespace reckon::models {
namespace {

std::string Joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>";
}

/// A leg of three joints: fixed ones before, between and behind them, frames that are turned, axes
/// that are no coordinate axes; `knee` is the type of the third. Beside it another leg and a foot
/// that hangs on nothing that moves.
UrdfRobot Robot(const std::string& knee = "revolute") {
  const std::string limit = "<limit lower='-3' upper='3' effort='1' velocity='1'/>";
  std::string text = "<robot name='r'>";
  for (const char* link : {"base", "mount", "hip", "bracket", "thigh", "shank", "foot", "other",
                           "other_foot", "bumper"}) {
    text += "<link name='" + std::string(link) + "'/>";
  }
  text += Joint("mounting", "fixed", "base", "mount", "<origin xyz='0.3 0.1 0' rpy='0.2 0 0.5'/>");
  text += Joint("abduct", "revolute", "mount", "hip",
                "<origin xyz='0 0.05 -0.02' rpy='0 0.4 0'/><axis xyz='1 0 0'/>" + limit);
  text += Joint("spacer", "fixed", "hip", "bracket", "<origin xyz='0 0.08 0' rpy='0 0 -0.3'/>");
  text += Joint("swing", "continuous", "bracket", "thigh",
                "<origin xyz='0.01 0 0.02' rpy='0.7 -0.2 0.1'/><axis xyz='0.1 1 -0.3'/>");
  text += Joint("bend", knee, "thigh", "shank",
                "<origin xyz='0 0 -0.2' rpy='0 0 1.1'/><axis xyz='0 1 0.5'/>" + limit);
  text += Joint("sole", "fixed", "shank", "foot", "<origin xyz='0.02 0 -0.25' rpy='0 0.3 0'/>");
  text += Joint("other_swing", "continuous", "base", "other", "<axis xyz='0 1 0'/>");
  text += Joint("other_sole", "fixed", "other", "other_foot", "<origin xyz='0 0 -0.3'/>");
  text += Joint("front", "fixed", "base", "bumper", "<origin xyz='0.5 0 0'/>");
  return UrdfRobot::FromText(text + "</robot>", "leg.urdf");
}

/// What the encoders report: another leg's joint among this leg's, which are out of order.
const std::vector<std::string> kEncoders{"bend", "other_swing", "abduct", "swing"};

EncoderVector RandomAngles(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  EncoderVector q(kEncoders.size());
  for (double& value : q) value = angle(random);
  return q;
}

/// The foot by way of the whole tree.
Eigen::Vector3d FootByTree(const UrdfRobot& robot, const EncoderVector& q) {
  std::vector<double> joints(robot.joints().size());
  for (std::size_t i = 0; i < kEncoders.size(); ++i) {
    joints[robot.JointIndex(kEncoders[i])] = q[static_cast<Eigen::Index>(i)];
  }
  return robot.LinkPose(robot.LinkIndex("foot"), joints).p;
}

class LegKinematicsOf : public testing::TestWithParam<const char*> {};

TEST_P(LegKinematicsOf, PutsTheFootWhereTheTreeDoes) {
  const UrdfRobot robot = Robot(GetParam());
  const LegKinematics leg(robot, "foot", kEncoders);
  EXPECT_EQ(leg.foot(), "foot");
  EXPECT_EQ(std::vector<int>(leg.entries().begin(), leg.entries().end()),
            (std::vector<int>{2, 3, 0}));
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const EncoderVector q = RandomAngles(random);
    // Lengths below 2 m and a dozen products: some 1e-15 of round-off.
    EXPECT_LT((leg.Evaluate(q).p_BF - FootByTree(robot, q)).norm(), 1e-12);
  }
}

TEST_P(LegKinematicsOf, HasTheJacobianOfItsPosition) {
  const LegKinematics leg(Robot(GetParam()), "foot", kEncoders);
  std::mt19937 random(2);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 100; ++i) {
    const EncoderVector q = RandomAngles(random);
    const FootPosition foot = leg.Evaluate(q);
    ASSERT_EQ(foot.J.cols(), 3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      EncoderVector above = q, below = q;
      above[leg.entries()[static_cast<std::size_t>(k)]] += kStep;
      below[leg.entries()[static_cast<std::size_t>(k)]] -= kStep;
      const Eigen::Vector3d slope =
          (leg.Evaluate(above).p_BF - leg.Evaluate(below).p_BF) / (2.0 * kStep);
      // Truncation h²/6 |p'''| < 4e-11 for |p'''| < 2 m, round-off 1e-15 / h = 1e-10.
      EXPECT_LT((foot.J.col(k) - slope).norm(), 1e-9) << "joint " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Knee, LegKinematicsOf, testing::Values("revolute", "prismatic"));

TEST(LegKinematics, OtherLegsDoNotMoveTheFoot) {
  const LegKinematics leg(Robot(), "foot", kEncoders);
  EncoderVector q = EncoderVector::Constant(4, 0.3);
  const Eigen::Vector3d before = leg.Evaluate(q).p_BF;
  q[1] = -1.0;  // other_swing
  EXPECT_EQ(leg.Evaluate(q).p_BF, before);
  q[0] = -1.0;  // control: bend
  EXPECT_GT((leg.Evaluate(q).p_BF - before).norm(), 0.1);
}

std::string Refusal(const UrdfRobot& robot, const std::string& foot,
                    const std::vector<std::string>& encoders) {
  try {
    LegKinematics(robot, foot, encoders);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LegKinematics, RefusesWhatIsNoLeg) {
  EXPECT_EQ(Refusal(Robot(), "foot", kEncoders), "");
  EXPECT_EQ(Refusal(Robot(), "paw", kEncoders), "leg.urdf: there is no link 'paw'");
  EXPECT_EQ(Refusal(Robot(), "foot", {"bend", "abduct"}),
            "the leg of 'foot' has a joint without an encoder: 'swing'");
  EXPECT_EQ(Refusal(Robot(), "bumper", kEncoders),
            "the foot 'bumper' hangs on 0 moving joints, expected 1 to 8");
  // A tail of n joints: eight are the most.
  const auto tail = [](int n) {
    std::string text = "<robot name='r'><link name='l0'/>";
    std::vector<std::string> joints;
    for (int i = 1; i <= n; ++i) {
      const std::string child = "l" + std::to_string(i), parent = "l" + std::to_string(i - 1);
      joints.push_back("j" + std::to_string(i));
      text +=
          "<link name='" + child + "'/>" + Joint(joints.back(), "continuous", parent, child, "");
    }
    return Refusal(UrdfRobot::FromText(text + "</robot>"), "l" + std::to_string(n), joints);
  };
  EXPECT_EQ(tail(kMaxLegJoints), "");
  EXPECT_EQ(tail(kMaxLegJoints + 1), "the foot 'l9' hangs on 9 moving joints, expected 1 to 8");
}

TEST(LegKinematics, EvaluatesWithoutAllocation) {
  const LegKinematics leg(Robot(), "foot", kEncoders);
  const EncoderVector q = EncoderVector::Constant(4, 0.3);
  testing_models::allocations = 0;
  const FootPosition foot = leg.Evaluate(q);
  const long counted = testing_models::allocations;
  EXPECT_EQ(counted, 0);
  EXPECT_TRUE(foot.J.allFinite());
  testing_models::allocations = 0;
  const Eigen::MatrixXd dynamic = foot.J;  // control: the counter counts
  const long control = testing_models::allocations;
  EXPECT_GE(control, 1);
  EXPECT_EQ(dynamic.cols(), 3);
}

}  // namespace
}  // namespace reckon::models
