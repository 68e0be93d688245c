#include <gtest/gtest.h>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "reckon/estimator/depth_model.h"
#include "reckon/estimator/error_form.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::WorstCorrelationError;

constexpr ErrorForm kRight = ErrorForm::kRightInvariant, kLeft = ErrorForm::kLeftInvariant;

/// One belief in both invariant forms.
struct Both {
  explicit Both(Draws& draws) {
    NavigationState x = draws.State();
    x.p = draws.Vector(1.0);  // what the switch turns with, and loses digits by
    const ErrorCovariance P = draws.Covariance<15>(testing_estimator::UsualSigma());
    right.Start(x, P);
    left.Start(x, P);
  }

  /// How far apart they are, the left one switched to right-invariant coordinates at `x`.
  double Apart(const NavigationState& x) const {
    return WorstCorrelationError(ConvertForm(left.P().Dense(), kLeft, kRight, x),
                                 right.P().Dense());
  }
  double MeansApart() const { return ErrorBetween(kRight, left.x(), right.x()).norm(); }

  RightInvariantEkf right;
  LeftInvariantEkf left;
};

TEST(FormSwitch, PropagationIsTheSameInBothForms) {
  Draws draws(91);
  Both both(draws);
  const ProcessNoise noise{4e-6, 1e-4, 1e-8, 1e-6};
  const Vector3d gravity(0, 0, -9.81);
  for (int i = 0; i < 200; ++i) {
    const Increment u(draws.Vector(1.0), draws.Vector(10.0), 0.005);
    both.right.Propagate(u, gravity, noise);
    both.left.Propagate(u, gravity, noise);
  }
  // 200 steps of round-off, and the switch's own some metres from the origin.
  EXPECT_LT(both.Apart(both.right.x()), 1e-10);
  EXPECT_LT(both.MeansApart(), 1e-11);
}

/// The same measurement taken in by both; the state before it.
template <int kRows>
NavigationState Correct(Both& both, const Linearisation<kRows>& m) {
  const NavigationState before = both.right.x();
  const auto correct = [&](auto& core) {
    const auto& own = core.Convert(m, before);
    const KalmanCorrection<kRows> kalman(core.P(), own);
    core.Retract(kalman.Gain());
    kalman.UpdateCovariance(core.P());
  };
  correct(both.right);
  correct(both.left);
  return before;
}

void ExpectTheSame(Both& both, const NavigationState& before) {
  EXPECT_LT(both.MeansApart(), 1e-11);
  // A covariance stays in the frame of the state that was corrected: there the switch is exact.
  EXPECT_LT(both.Apart(before), 1e-10);
  // At the corrected state, one lacks the transport by the correction.
  EXPECT_GT(both.Apart(both.right.x()), 1e-5);
}

TEST(FormSwitch, AVelocityInBodyAxesCorrectsBothAlike) {
  Draws draws(92);
  for (int i = 0; i < 10; ++i) {
    Both both(draws);
    models::BodyVelocitySample y;
    y.v_WS_S = both.right.x().R.transpose() * both.right.x().v + draws.Vector(0.1);
    y.covariance = draws.Covariance<3>(Vector3d(0.02, 0.03, 0.04));
    const models::Pose X_IS{draws.Rotation(), draws.Vector(0.3)};
    y.v_WS_S = X_IS.R.transpose() * y.v_WS_S;
    ExpectTheSame(both, Correct(both, LinearisedVelocity(y, X_IS, {}, both.right.x())));
  }
}

TEST(FormSwitch, ADepthInWorldAxesCorrectsBothAlike) {
  Draws draws(93);
  for (int i = 0; i < 10; ++i) {
    Both both(draws);
    const Vector3d r = draws.Vector(0.3);
    const double depth = -(both.right.x().p + both.right.x().R * r).z() + draws.Normal();
    ExpectTheSame(both, Correct(both, LinearisedDepth({depth}, r, 0.05, both.right.x())));
  }
}

}  // namespace
}  // namespace reckon::estimator
