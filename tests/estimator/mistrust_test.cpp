#include "reckon/estimator/mistrust.h"

#include <gtest/gtest.h>

#include "estimator/simulated_drive.h"
#include "reckon/estimator/gate.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;

/// When the belief is blamed first, if rows come every 50 ms from time 0 on and `rejected`(t) says
/// what becomes of them; negative: never within 100 s.
template <class Rejected>
double BlamedAt(const Rejected& rejected, double patience_s = 2.0, int other_rows = 0) {
  Mistrust mistrust(patience_s);
  mistrust.Start(0);
  for (models::TimeNs t = 0; t < 100'000 * kMs; t += 50 * kMs) {
    if (other_rows > 0) mistrust.Heard(t, other_rows, false);
    mistrust.Heard(t, 3, rejected(models::Seconds(t)));
    if (mistrust.OfBelief()) return models::Seconds(t);
  }
  return -1.0;
}

TEST(Mistrust, BlamesTheBeliefWhenAllIsRejectedForAsLongAsPatienceLasts) {
  EXPECT_NEAR(BlamedAt([](double) { return true; }), 2.0, 0.051);
  // After ten seconds of use half the weight is gone at 2 s ln 2 = 1.4 s, and patience starts.
  EXPECT_NEAR(BlamedAt([](double t) { return t >= 10.0; }), 13.4, 0.11);
}

TEST(Mistrust, BlamesTheSensorWhileMostIsUsed) {
  EXPECT_LT(BlamedAt([](double) { return true; }, 2.0, 4), 0.0) << "another sensor agrees";
  EXPECT_LT(BlamedAt([](double t) { return std::fmod(t, 1.0) < 0.4; }), 0.0);
  EXPECT_LT(BlamedAt([](double t) { return t > 10.0 && t < 12.0; }), 0.0) << "it passes";
}

TEST(Mistrust, NeverBlamesTheBeliefWithoutPatience) {
  EXPECT_LT(BlamedAt([](double) { return true; }, 0.0), 0.0);
}

TEST(Mistrust, StartsToCountWithTheFirstRejectionAfterASilence) {
  Mistrust mistrust(2.0);
  mistrust.Start(0);
  mistrust.Heard(0, 3, false);
  for (models::TimeNs t = 60'000 * kMs; t < 61'900 * kMs; t += 100 * kMs) {
    mistrust.Heard(t, 3, true);
    EXPECT_FALSE(mistrust.OfBelief()) << t;
  }
}

/// The error of the velocity 10 s after the filter was thrown off by 15 m/s.
double VelocityErrorAfterAJolt(double patience_s, int& widened) {
  estimator::Setup setup = TestSetup();
  setup.gate.patience_s = patience_s;
  SimulatedDrive drive(setup, 3);
  Prior prior = drive.DrawPrior(TestPrior().covariance);
  prior.v_WB += Vector3d(15, 0, 0);
  auto filter = Make("inekf", setup, prior);
  widened = 0;
  for (int i = 1; i <= 2000; ++i) {
    (void)filter->Process(drive.Advance());
    if (i % 10 != 0) continue;
    const Report report = filter->Process(drive.Velocity(0.02));
    widened += report.corrections()[0].decision == Decision::kWidened ? 1 : 0;
  }
  return (filter->Belief()->v_WB - drive.Body().v).norm();
}

TEST(Mistrust, LetsAFilterThatIsWrongAndSureComeBack) {
  int widened = 0;
  EXPECT_LT(VelocityErrorAfterAJolt(2.0, widened), 0.1);
  EXPECT_GE(widened, 1);
  // Negative control: it stays 15 m/s off.
  EXPECT_GT(VelocityErrorAfterAJolt(0.0, widened), 10.0);
  EXPECT_EQ(widened, 0);
}

TEST(NisWithCurvature, CountsWhatTheFirstOrderLeavesOut) {
  // A velocity seen under a tilt of 60°: z = (turn − 1) g t, of which the first order says θ × g t.
  Correction c{.rows = 3};
  const Vector3d g_t(0, 0, -0.4905), theta(1.047, 0, 0);
  c.innovation = Exp(theta) * g_t - g_t;
  const Eigen::Matrix3d G = Skew(g_t), P = 1.1 * Eigen::Vector3d(1, 1, 1e-4).asDiagonal();
  c.covariance = G * P * G.transpose() + 0.0025 * Eigen::Matrix3d::Identity();
  const double plain = c.innovation.dot(c.covariance.inverse() * c.innovation);
  EXPECT_GT(plain, ChiSquareQuantile(3, 0.9999)) << "the fall of the vertical looks impossible";
  EXPECT_LT(NisWithCurvature(c, P), ChiSquareQuantile(3, 0.9999));
  // With a known orientation it is the plain one.
  c.nis = plain;
  EXPECT_NEAR(NisWithCurvature(c, Eigen::Matrix3d::Zero()), plain, 1e-9 * plain);
}

}  // namespace
}  // namespace reckon::estimator
