// How a filter is told which feet stand, how it uses them, and what it makes of slip.
#include <gtest/gtest.h>

#include <stdexcept>

#include "estimator/quadruped.h"
#include "reckon/estimator/imu_filter.h"

namespace reckon::estimator {
namespace {

using models::FootForceSample;
using testing_estimator::ContactsAt;
using testing_estimator::JointsAt;
using testing_estimator::kMs;
using testing_estimator::QuadrupedSetup;
using testing_estimator::RestingImu;
using testing_estimator::Stance;
using testing_estimator::TestPrior;
using testing_estimator::TimeNs;
using Filter = ImuFilter<RightInvariantEkf>;

constexpr models::SensorId kForces = 4;

estimator::Setup WithForces(const ContactDetection& told) {
  estimator::Setup setup = QuadrupedSetup();
  setup.suite.sensors.push_back({"forces", models::SensorKind::kFootForces, {}, 5 * kMs});
  setup.contacts = told;
  setup.contacts.sensor = "forces";
  return setup;
}

models::Measurement ForcesAt(TimeNs t, double first_n) {
  FootForceSample sample;
  sample.force_n = Eigen::Vector4d(first_n, 0, 0, 0);
  return {kForces, t, t, sample};
}

/// The probability of the first foot after each of these forces, 5 ms apart.
std::vector<double> Probabilities(const ContactDetection& told, const std::vector<double>& forces) {
  Filter filter(WithForces(told));
  filter.Start(TestPrior());
  std::vector<double> probabilities;
  TimeNs t_ns = 0;
  for (const double force : forces) {
    t_ns += 5 * kMs;
    EXPECT_EQ(filter.Process(RestingImu(t_ns)).refusal, Refusal::kNone);
    EXPECT_EQ(filter.Process(ForcesAt(t_ns, force)).refusal, Refusal::kNone);
    EXPECT_EQ(filter.Process(JointsAt(t_ns, Stance())).refusal, Refusal::kNone);
    probabilities.push_back(filter.Belief()->contact[0]);
    EXPECT_EQ(filter.core().P().active().size(), probabilities.back() > 0.5 ? 6U : 5U);
  }
  return probabilities;
}

TEST(ContactDetection, SwitchesAtItsThresholds) {
  const ContactDetection told{.sensor = "", .cutoff_hz = 0, .threshold_n = 20, .hysteresis_n = 8};
  EXPECT_EQ(Probabilities(told, {19, 21, 13, 11, 13, 21}), (std::vector<double>{0, 1, 1, 0, 0, 1}));
}

TEST(ContactDetection, SmoothsTheForceWithOnePole) {
  // From 0 N, a step to 40 N passes 20 N after ln 2 / (2π · 10 Hz) = 11 ms: the third sample.
  const ContactDetection told{.sensor = "", .cutoff_hz = 10, .threshold_n = 20};
  EXPECT_EQ(Probabilities(told, {0, 40, 40, 40}), (std::vector<double>{0, 0, 0, 1}));
}

TEST(ContactDetection, IsAProbabilityByTheLogistic) {
  const ContactDetection told{.sensor = "", .cutoff_hz = 0, .threshold_n = 20, .logistic_n = 4};
  const auto p = Probabilities(told, {16, 20, 24});
  EXPECT_NEAR(p[0], 1 / (1 + std::exp(1.0)), 1e-12);
  EXPECT_NEAR(p[1], 0.5, 1e-12);
  EXPECT_NEAR(p[2], 1 / (1 + std::exp(-1.0)), 1e-12);
}

TEST(ContactDetection, LeavesTheContactSensorUnusedBesideForces) {
  Filter filter(WithForces({}));
  filter.Start(TestPrior());
  EXPECT_EQ(filter.Process(RestingImu(5 * kMs)).refusal, Refusal::kNone);
  EXPECT_EQ(filter.Process(ContactsAt(5 * kMs, true, true, true, true)).refusal, Refusal::kUnused);
}

TEST(ContactDetection, RefusesWhatCannotTell) {
  estimator::Setup setup = QuadrupedSetup();
  setup.contacts.sensor = "joints";
  EXPECT_THROW(Filter{setup}, std::invalid_argument);
  setup.suite.sensors.push_back({"torques", models::SensorKind::kTorques, {}, 5 * kMs});
  setup.contacts.sensor = "torques";
  EXPECT_THROW(Filter{setup}, std::invalid_argument);  // no masses are known
}

/// The error of the velocity along x after a robot at rest stood for half a second on four feet of
/// which the first is dragged along x at 0.3 m/s in the last 100 ms, beside what was reported.
struct Dragged {
  double velocity_m_s = 0.0;
  int inflated = 0, rejected = 0;
};

Dragged Drag(const estimator::Setup& setup) {
  Filter filter(setup);
  filter.Start(TestPrior());
  const models::LegKinematics& leg = setup.suite.legs->legs[0];
  models::EncoderVector angles = Stance();
  Dragged dragged;
  for (TimeNs t_ns = 5 * kMs; t_ns <= 500 * kMs; t_ns += 5 * kMs) {
    (void)filter.Process(RestingImu(t_ns));
    (void)filter.Process(ContactsAt(t_ns, true, true, true, true));
    models::Measurement joints = JointsAt(t_ns, angles);
    if (t_ns > 400 * kMs) {
      const auto J = leg.Evaluate(angles).J;  // x and z against hip and knee
      Eigen::Matrix2d planar;
      planar << J(0, 0), J(0, 1), J(2, 0), J(2, 1);
      const Eigen::Vector2d rate = planar.inverse() * Eigen::Vector2d(0.3, 0.0);
      angles.head<2>() += 5e-3 * rate;
      joints = JointsAt(t_ns, angles);
      std::get<models::EncoderSample>(joints.sample).rate_rad_s.head<2>() = rate;
    }
    const Report report = filter.Process(joints);
    for (const Correction& correction : report.corrections()) {
      dragged.inflated += correction.decision == Decision::kInflated ? 1 : 0;
      dragged.rejected += correction.decision == Decision::kRejected ? 1 : 0;
    }
  }
  dragged.velocity_m_s = std::abs(filter.Belief()->v_WB.x());
  return dragged;
}

estimator::Setup ForSlip(const SlipRejection& slip) {
  estimator::Setup setup = QuadrupedSetup();
  setup.gate.action = GateAction::kOff;
  setup.noise.foot_slip_m_per_s_sqrt_hz = 0.01;
  setup.noise.joint_rate_rad_per_s = 0.05;
  setup.noise.leg_velocity_m_per_s = 0.03;
  setup.slip = slip;
  return setup;
}

TEST(Slip, OfOneFootMovesTheBodyLessOnceItIsSeen) {
  const Dragged none = Drag(ForSlip({}));
  ASSERT_GT(none.velocity_m_s, 0.01);  // the drag is felt at all
  EXPECT_EQ(none.inflated, 0);
  const Dragged widened = Drag(ForSlip({.rule = SlipRule::kNis}));
  EXPECT_GE(widened.inflated, 15);  // of 20 samples
  EXPECT_LT(widened.velocity_m_s, 0.5 * none.velocity_m_s);
  const Dragged dropped = Drag(ForSlip({.rule = SlipRule::kNis, .action = SlipAction::kDrop}));
  EXPECT_GE(dropped.rejected, 15);
  EXPECT_LT(dropped.velocity_m_s, 0.5 * none.velocity_m_s);
}

TEST(Slip, BySpeedNeedsTheSpeedThatItWasTold) {
  const Dragged none = Drag(ForSlip({}));
  const Dragged slow = Drag(ForSlip({.rule = SlipRule::kSpeed, .speed_m_s = 0.4}));
  EXPECT_EQ(slow.velocity_m_s, none.velocity_m_s);  // 0.3 m/s is below it
  const Dragged fast = Drag(ForSlip({.rule = SlipRule::kSpeed, .speed_m_s = 0.15, .factor = 100}));
  EXPECT_LT(fast.velocity_m_s, none.velocity_m_s);
}

TEST(LegOdometry, TellsTheVelocityOfABodyOverItsFeet) {
  // A body that moves over a standing foot of radius r: the joints see minus its velocity, and the
  // foot's middle moves as it rolls. The truth is made by moving the body and rolling the foot.
  estimator::Setup setup = ForSlip({});
  setup.leg_correction = LegCorrection::kVelocity;
  const Eigen::Vector3d v(0.4, -0.1, 0.05), w(0.1, 0.3, -0.2);
  NavigationState x;
  FootReading y;
  y.h = Eigen::Vector3d(0.2, 0.1, -0.5);
  y.w_rad_s = Eigen::Vector3d(0.5, -2.0, 0.1);
  const double radius = 0.02;
  const Eigen::Vector3d middle = (w + y.w_rad_s).cross(Eigen::Vector3d(0, 0, radius));
  y.dh_m_s = middle - v - w.cross(y.h);  // ḣ of a foot whose middle moves so
  const auto m = LinearisedLegOdometry(y, radius, setup.noise, {w, 0.0}, x);
  EXPECT_LT((m.z - v).norm(), 1e-15);  // x stands still: the innovation is the velocity
}

TEST(LegOdometry, IsACorrectionOfItsOwnWithoutFeetInTheState) {
  estimator::Setup setup = ForSlip({});
  setup.leg_correction = LegCorrection::kVelocity;
  Filter filter(setup);
  Prior prior = TestPrior();
  prior.v_WB.x() += 0.05;
  filter.Start(prior);
  for (TimeNs t_ns = 5 * kMs; t_ns <= 200 * kMs; t_ns += 5 * kMs) {
    (void)filter.Process(RestingImu(t_ns));
    (void)filter.Process(ContactsAt(t_ns, true, true, true, true));
    const Report report = filter.Process(JointsAt(t_ns, Stance()));
    EXPECT_EQ(report.corrections().size(), 4U);
  }
  EXPECT_EQ(filter.core().P().active().size(), 5U);
  EXPECT_LT(filter.Belief()->v_WB.norm(), 0.01);  // 160 looks of 0.03 m/s each
}

}  // namespace
}  // namespace reckon::estimator
