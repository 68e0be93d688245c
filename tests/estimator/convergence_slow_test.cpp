#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "estimator/forms.h"
#include "estimator/simulated_drive.h"

// From a tilt that is wrong by 60 degrees, while the robot turns and accelerates.
namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::kForms;
using testing_estimator::MakeOf;
using testing_estimator::NameOf;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;

constexpr int kDraws = 100;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTilt = 60.0 * kDegree;
constexpr double kSigma = 0.05;  ///< of the velocity sensor, m/s
constexpr int kRate = 200;

/// A prior whose orientation is off by 60 degrees about a level axis, and says so: a turn of the
/// whole estimate, which is what a right-invariant error is.
Prior Tilted(SimulatedDrive& drive, Draws& draws) {
  ErrorCovariance P = TestPrior().covariance;
  P.diagonal().segment<2>(kTheta).setZero();
  Prior prior = drive.DrawPrior(P);
  const double direction = draws.Uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Matrix3d turn = Exp(kTilt * Vector3d(std::cos(direction), std::sin(direction), 0.0));
  prior.X_WB = {turn * prior.X_WB.R, turn * prior.X_WB.p};
  prior.v_WB = turn * prior.v_WB;
  prior.covariance.diagonal().segment<2>(kTheta).setConstant(kTilt * kTilt);
  return prior;
}

double Tilt(const Estimate& e, const NavigationState& truth) {
  const Vector3d up = e.X_WB.R.row(2), true_up = truth.R.row(2);
  return std::atan2(up.cross(true_up).norm(), up.dot(true_up));
}

double Heading(const Eigen::Matrix3d& R) { return std::atan2(R(1, 0), R(0, 0)); }

struct Outcome {
  int converged = 0;                   ///< below a degree from 10 s to 12 s
  std::vector<double> seconds;         ///< until it stays below a degree
  std::vector<double> final_tilt_deg;  ///< at 12 s
  double heading_square = 0.0;         ///< of the change of its error from 10 s on, mean
};

Outcome Converge(ErrorForm form, GateAction gate) {
  Outcome outcome;
  estimator::Setup setup = TestSetup();
  setup.gate.action = gate;
  for (int draw = 0; draw < kDraws; ++draw) {
    SimulatedDrive drive(setup, 500 + static_cast<std::uint64_t>(draw));
    Draws draws(900 + static_cast<std::uint64_t>(draw));
    auto filter = MakeOf(form, setup, Tilted(drive, draws));
    int last_above = 0;
    double heading = 0.0, change = 0.0;
    for (int i = 1; i <= 12 * kRate; ++i) {
      (void)filter->Process(drive.Advance());
      if (i % 10 == 0) (void)filter->Process(drive.Velocity(kSigma));
      const Estimate e = *filter->Belief();
      const NavigationState truth = drive.Body();
      if (Tilt(e, truth) > kDegree) last_above = i;
      const double error = Heading(e.X_WB.R) - Heading(truth.R);
      if (i == 10 * kRate) heading = error;
      change = std::remainder(error - heading, 2.0 * std::numbers::pi);
      if (i == 12 * kRate) outcome.final_tilt_deg.push_back(Tilt(e, truth) / kDegree);
    }
    outcome.converged += last_above < 10 * kRate ? 1 : 0;
    outcome.seconds.push_back(static_cast<double>(last_above) / kRate);
    outcome.heading_square += change * change / kDraws;
  }
  return outcome;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void Print(const std::string& name, const Outcome& o) {
  std::printf(
      "%-24s %3d of %d below 1 deg within 10 s; median %5.2f s, tilt at 12 s %6.3f deg; "
      "heading moves by %.2f deg RMS from 10 s to 12 s\n",
      name.c_str(), o.converged, kDraws, Median(o.seconds), Median(o.final_tilt_deg),
      std::sqrt(o.heading_square) / kDegree);
}

TEST(Convergence, FromSixtyDegreesOfTilt) {
  for (const ErrorForm form : kForms) {
    for (const GateAction gate : {GateAction::kReject, GateAction::kOff}) {
      const Outcome o = Converge(form, gate);
      Print(NameOf(form) + (gate == GateAction::kOff ? ", no gate" : ""), o);
      if (form == ErrorForm::kRightInvariant) {
        EXPECT_GE(o.converged, 95);
      }
    }
  }
}

TEST(Convergence, FailsWithoutThePriorThatSaysSo) {
  // Negative control: a filter that is sure of a wrong tilt throws all away, for ever if its gate
  // has endless patience.
  estimator::Setup setup = TestSetup();
  setup.gate.patience_s = 0.0;
  SimulatedDrive drive(setup, 500);
  Draws draws(900);
  Prior prior = Tilted(drive, draws);
  prior.covariance = TestPrior().covariance;
  auto filter = MakeOf(ErrorForm::kRightInvariant, setup, prior);
  for (int i = 1; i <= 10 * kRate; ++i) {
    (void)filter->Process(drive.Advance());
    if (i % 10 == 0) (void)filter->Process(drive.Velocity(kSigma));
  }
  EXPECT_GT(Tilt(*filter->Belief(), drive.Body()), kDegree);
}

}  // namespace
}  // namespace reckon::estimator
