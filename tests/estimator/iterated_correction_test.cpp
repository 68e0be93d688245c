#include "reckon/estimator/iterated_correction.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <functional>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "reckon/estimator/pose_model.h"
#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Mat15;
using testing_estimator::Real;
using testing_estimator::State;
using testing_estimator::Vec15;
using testing_estimator::Vec3;

/// The residuals of a sensor at a state, in its own units: independent, of variance one.
using Whitened = std::function<Vec3(const State&)>;

/// argmin over ξ of |ξ|² in P⁻¹ + |r(exp(ξ) X̂)|² by Levenberg and Marquardt, with a numerical
/// Jacobian about each ξ.
class BruteForce {
 public:
  BruteForce(const State& prior, const ErrorCovariance& P, Whitened r)
      : prior_(prior), r_(std::move(r)) {
    const Mat15 wide = P.cast<Real>();
    L_inverse_ = Mat15(wide.llt().matrixL()).inverse();
  }

  State At(const Vec15& xi) const {
    return testing_estimator::TruthBehind(ErrorForm::kRightInvariant, prior_, -xi);
  }
  Real Cost(const Vec15& xi) const { return Residuals(xi).squaredNorm(); }

  Vec15 Minimum() const {
    Vec15 xi = Vec15::Zero();
    Real damping = 1e-3L;
    for (int i = 0; i < 300; ++i) {
      const auto J = testing_estimator::Differences<18>(
          [&](const Vec15& d) -> Vec18 { return Residuals(xi + d); });
      const Vec15 gradient = J.transpose() * Residuals(xi);
      Mat15 A = J.transpose() * J;
      A.diagonal() *= 1 + damping;
      const Vec15 step = A.ldlt().solve(gradient);
      if (Cost(xi - step) < Cost(xi)) {
        xi -= step;
        damping /= 10;
      } else {
        damping *= 10;
        if (damping > 1e12L) break;  // nothing is lower
      }
    }
    return xi;
  }

 private:
  using Vec18 = Eigen::Matrix<Real, 18, 1>;

  Vec18 Residuals(const Vec15& xi) const {
    Vec18 all;
    all << L_inverse_ * xi, r_(At(xi));
    return all;
  }

  State prior_;
  Whitened r_;
  Mat15 L_inverse_;
};

/// A prior that is off by half a radian and says so.
struct Case {
  explicit Case(Draws& draws) : x(draws.State()) {
    Eigen::Matrix<double, 15, 1> sigma = testing_estimator::UsualSigma();
    sigma.head<3>().setConstant(0.5);
    x.v = draws.Vector(3.0);
    x.p = draws.Vector(3.0);
    P = draws.Covariance<15>(sigma);
    const ErrorVector e = P.llt().matrixL() * draws.Normals<15>();
    truth = testing_estimator::TruthBehind(ErrorForm::kRightInvariant,
                                           testing_estimator::Widened(x), e.cast<Real>());
  }
  NavigationState x;
  ErrorCovariance P;
  State truth;
};

/// The distance of a core's mean from the minimum, and from where one correction ends.
struct Distances {
  double iterated, single;
};

template <class Model>
Distances Compare(const Case& c, const Model& model, const Whitened& residuals) {
  RightInvariantEkf core;
  core.Start(c.x, c.P);
  CorrectIterated<3>(core, model, 100);
  RightInvariantEkf once;
  once.Start(c.x, c.P);
  CorrectIterated<3>(once, model, 1);
  const BruteForce brute(testing_estimator::Widened(c.x), c.P, residuals);
  const State best = brute.At(brute.Minimum());
  const auto distance = [&](const RightInvariantEkf& found) {
    return static_cast<double>(testing_estimator::Error(ErrorForm::kRightInvariant,
                                                        testing_estimator::Widened(found.x()), best)
                                   .norm());
  };
  return {distance(core), distance(once)};
}

TEST(CorrectIterated, OfAVelocityEndsAtTheMostProbableState) {
  Draws draws(81);
  for (int i = 0; i < 10; ++i) {
    const Case c(draws);
    models::BodyVelocitySample y;
    y.covariance = draws.Covariance<3>(Vector3d(0.02, 0.03, 0.04));
    const models::Pose X_IS{draws.Rotation(), Vector3d::Zero()};
    y.v_WS_S = X_IS.R.transpose() * (c.truth.R.transpose() * c.truth.v).cast<double>() +
               draws.Vector(0.03);
    const testing_estimator::Mat3 whiten =
        testing_estimator::Mat3(y.covariance.cast<Real>().llt().matrixL()).inverse();
    const auto [iterated, single] = Compare(
        c, [&](const NavigationState& x) { return LinearisedVelocity(y, X_IS, {}, x); },
        [&](const State& x) -> Vec3 {
          return whiten *
                 (y.v_WS_S.cast<Real>() - X_IS.R.transpose().cast<Real>() * x.R.transpose() * x.v);
        });
    // CorrectIterated stops where a step is below 1e-10.
    EXPECT_LT(iterated, 1e-8) << i;
    EXPECT_GT(single, 1e-3) << i << ": one step is not enough";
  }
}

TEST(CorrectIterated, OfAPositionOnALeverArmEndsAtTheMostProbableState) {
  Draws draws(82);
  for (int i = 0; i < 10; ++i) {
    const Case c(draws);
    models::PoseSample y;
    y.position_sigma_m = Vector3d(0.1, 0.2, 0.3);
    const models::Pose X_IS{Matrix3d::Identity(), draws.Vector(1.5)};
    y.X_WS.p = (c.truth.p + c.truth.R * X_IS.p.cast<Real>()).cast<double>() + draws.Vector(0.2);
    const auto [iterated, single] = Compare(
        c, [&](const NavigationState& x) { return LinearisedPosition(y, X_IS, 1.0, x); },
        [&](const State& x) -> Vec3 {
          const Vec3 read = x.p + x.R * X_IS.p.cast<Real>();
          return (y.X_WS.p.cast<Real>() - read).cwiseQuotient(y.position_sigma_m.cast<Real>());
        });
    EXPECT_LT(iterated, 1e-8) << i;
    EXPECT_GT(single, 1e-3) << i << ": one step is not enough";
  }
}

}  // namespace
}  // namespace reckon::estimator
