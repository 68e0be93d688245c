#include "reckon/estimator/gate.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace reckon::estimator {
namespace {

TEST(ChiSquareQuantile, AgreesWithPublishedTables) {
  // Pearson and Hartley's table, and for the last two of each group the survival function inverted
  // with 30 digits.
  struct Case {
    int dof;
    double probability, quantile;
  };
  for (const Case& c : {Case{1, 0.95, 3.841458820694124}, Case{1, 0.99, 6.634896601021213},
                        Case{1, 0.9999, 15.136705226623397}, Case{2, 0.95, 5.991464547107979},
                        Case{2, 0.99, 9.210340371976180}, Case{2, 0.9999, 18.420680743952366},
                        Case{3, 0.5, 2.365973884375338}, Case{3, 0.95, 7.814727903251178},
                        Case{3, 0.99, 11.344866730144371}, Case{3, 0.9999, 21.107513466160214}}) {
    EXPECT_NEAR(ChiSquareQuantile(c.dof, c.probability), c.quantile, 1e-9 * c.quantile)
        << c.dof << " " << c.probability;
  }
}

TEST(ChiSquareQuantile, RefusesWhatItCannotInvert) {
  EXPECT_THROW(ChiSquareQuantile(0, 0.5), std::invalid_argument);
  EXPECT_THROW(ChiSquareQuantile(4, 0.5), std::invalid_argument);
  for (const double p : {0.0, 1.0, -0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(ChiSquareQuantile(1, p), std::invalid_argument) << p;
  }
}

TEST(InnovationGate, ActsAsItIsTold) {
  const double inside = 7.8, outside = 7.9;  // of the 95 % quantile for three rows, 7.8147
  const auto judge = [&](GateAction action, double nis) {
    return InnovationGate({action, 0.95}).Judge(3, nis);
  };
  for (const auto action :
       {GateAction::kOff, GateAction::kWarn, GateAction::kReject, GateAction::kInflate}) {
    EXPECT_EQ(judge(action, inside), Decision::kAccepted);
  }
  EXPECT_EQ(judge(GateAction::kOff, outside), Decision::kAccepted);
  EXPECT_EQ(judge(GateAction::kWarn, outside), Decision::kWarned);
  EXPECT_EQ(judge(GateAction::kReject, outside), Decision::kRejected);
  EXPECT_EQ(judge(GateAction::kInflate, outside), Decision::kInflated);
}

}  // namespace
}  // namespace reckon::estimator
