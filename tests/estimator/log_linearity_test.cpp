#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "estimator/forms.h"
#include "estimator/reference.h"
#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Cross;
using testing_estimator::Draws;
using testing_estimator::Mat3;
using testing_estimator::Real;
using testing_estimator::Series;
using testing_estimator::Vec3;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Wide9 = Eigen::Matrix<Real, 9, 1>;
using WideMatrix9 = Eigen::Matrix<Real, 9, 9>;

constexpr double kDt = 5e-3;
constexpr int kSteps = 1000;  ///< five seconds
const Vector3d kDown(0, 0, -9.81);

struct Input {
  Vector3d w, a;
};

/// Random rates of 1 rad/s and forces of gravity's size, every axis, new at each step.
std::vector<Input> RandomMotion(Draws& draws) {
  std::vector<Input> motion(kSteps);
  for (Input& u : motion) u = {draws.Vector(1.0), draws.Vector(10.0)};
  return motion;
}

NavigationState Carried(NavigationState x, const std::vector<Input>& motion) {
  for (const Input& u : motion) x = Propagated(x, {u.w, u.a, kDt}, kDown);
  return x;
}

/// Φ of one step in the right-invariant form: nothing of the state, nothing of the input.
WideMatrix9 RightPhi() {
  const Mat3 I = Mat3::Identity(), G = Cross(kDown.cast<Real>());
  const Real dt = kDt;
  WideMatrix9 Phi = WideMatrix9::Identity();
  Phi.block<3, 3>(3, 0) = G * dt;
  Phi.block<3, 3>(6, 0) = G * dt * dt / 2;
  Phi.block<3, 3>(6, 3) = I * dt;
  return Phi;
}

/// Φ of one step in the left-invariant form: nothing of the state.
WideMatrix9 LeftPhi(const Input& u) {
  const Real dt = kDt;
  const Vec3 phi = u.w.cast<Real>() * dt, a = u.a.cast<Real>();
  const Mat3 back = Series(0, phi).transpose();
  WideMatrix9 Phi = WideMatrix9::Zero();
  for (int i = 0; i < 9; i += 3) Phi.block<3, 3>(i, i) = back;
  Phi.block<3, 3>(3, 0) = -back * Cross(Series(1, phi) * a) * dt;
  Phi.block<3, 3>(6, 0) = -back * Cross(Series(2, phi) * a) * dt * dt;
  Phi.block<3, 3>(6, 3) = back * dt;
  return Phi;
}

/// Φ of one step in the multiplicative form, at the estimate.
WideMatrix9 MultiplicativePhi(const Input& u, const NavigationState& hat) {
  const Real dt = kDt;
  const Vec3 phi = u.w.cast<Real>() * dt, a = u.a.cast<Real>();
  const Mat3 R = hat.R.cast<Real>();
  WideMatrix9 Phi = WideMatrix9::Identity();
  Phi.block<3, 3>(0, 0) = Series(0, phi).transpose();
  Phi.block<3, 3>(3, 0) = -R * Cross(Series(1, phi) * a) * dt;
  Phi.block<3, 3>(6, 0) = -R * Cross(Series(2, phi) * a) * dt * dt;
  Phi.block<3, 3>(6, 3) = Mat3::Identity() * dt;
  return Phi;
}

/// Φ_k … Φ_1 ξ along the motion; `hat` is the estimate at its start.
Vector9 Linear(ErrorForm form, const Vector9& xi, NavigationState hat,
               const std::vector<Input>& motion) {
  const WideMatrix9 right = RightPhi();
  Wide9 e = xi.cast<Real>();
  for (const Input& u : motion) {
    switch (form) {
      case ErrorForm::kRightInvariant:
        e = right * e;
        break;
      case ErrorForm::kLeftInvariant:
        e = LeftPhi(u) * e;
        break;
      case ErrorForm::kMultiplicative:
        e = MultiplicativePhi(u, hat) * e;
        break;
    }
    hat = Propagated(hat, {u.w, u.a, kDt}, kDown);
  }
  return e.cast<double>();
}

/// A state without biases, and the estimate that errs from it by `xi` in `form`.
struct Pair {
  NavigationState x, hat;
};
Pair Erring(ErrorForm form, Draws& draws, const Vector9& xi) {
  Pair pair;
  pair.x = draws.State();
  pair.x.gyro_bias.setZero();
  pair.x.accel_bias.setZero();
  testing_estimator::Vec15 e = testing_estimator::Vec15::Zero();
  e.head<9>() = xi.cast<Real>();
  const auto wide = testing_estimator::Erring(form, testing_estimator::Widened(pair.x), e);
  pair.hat = pair.x;
  pair.hat.R = wide.R.cast<double>();
  pair.hat.v = wide.v.cast<double>();
  pair.hat.p = wide.p.cast<double>();
  return pair;
}

Vector9 DrawError(Draws& draws, double angle_rad) {
  Vector9 xi;
  xi << angle_rad * draws.Vector().normalized(), draws.Vector(10.0), draws.Vector(30.0);
  return xi;
}

/// The error of orientation `angle_rad` and tens of metres after five seconds less what Φ makes of
/// it, in parts of the latter.
double Nonlinearity(ErrorForm form, std::uint64_t seed, double angle_rad) {
  Draws draws(seed);
  const Vector9 xi = DrawError(draws, angle_rad);
  const std::vector<Input> motion = RandomMotion(draws);
  const Pair start = Erring(form, draws, xi);
  const Vector9 linear = Linear(form, xi, start.hat, motion);
  const Vector9 found =
      ErrorBetween(form, Carried(start.hat, motion), Carried(start.x, motion)).head<9>();
  return (found - linear).norm() / linear.norm();
}

// Round-off: a thousand steps of states of some hundred metres, in parts of errors of tens of
// metres; J⁻¹ of the logarithm multiplies it by less than 3.
constexpr double kRoundOff = 3e-13;

class LogLinearity : public ::testing::TestWithParam<ErrorForm> {};

TEST_P(LogLinearity, ErrorsOfAnySizeEvolveByPhi) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const double angle : {1e-3, 0.1, 1.0, 2.0, 2.5}) {
      EXPECT_LT(Nonlinearity(GetParam(), 100 + seed, angle), kRoundOff)
          << "seed " << seed << ", " << angle << " rad";
    }
  }
}

/// exp(ξ) as a point: what does not jump where the rotation vector does.
Vector9 Point(const Vector9& xi) {
  const Vector3d theta = xi.head<3>();
  const Eigen::Matrix3d J = Series(1, theta.cast<Real>()).cast<double>();
  Vector9 point;
  point << Series(0, theta.cast<Real>()).cast<double>() * Vector3d(1, 2, 3), J * xi.segment<3>(3),
      J * xi.segment<3>(6);
  return point;
}

TEST_P(LogLinearity, HoldsBeyondAHalfTurnToo) {
  // There the logarithm comes back by the short way: the group elements must agree, exp(Φξ) = η.
  for (const double angle : {3.1, std::numbers::pi, 3.2, 5.0}) {
    Draws draws(static_cast<std::uint64_t>(1000 * angle));
    const Vector9 xi = DrawError(draws, angle);
    const std::vector<Input> motion = RandomMotion(draws);
    const Pair start = Erring(GetParam(), draws, xi);
    const Vector9 linear = Linear(GetParam(), xi, start.hat, motion);
    const Vector9 found =
        ErrorBetween(GetParam(), Carried(start.hat, motion), Carried(start.x, motion)).head<9>();
    EXPECT_LE(found.head<3>().norm(), std::numbers::pi + 1e-12);
    EXPECT_LT((Point(found) - Point(linear)).norm(), kRoundOff * Point(linear).norm()) << angle;
  }
}

INSTANTIATE_TEST_SUITE_P(Invariant, LogLinearity,
                         ::testing::Values(ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant),
                         [](const auto& form) { return testing_estimator::NameOf(form.param); });

TEST(LogLinearityControl, TheMultiplicativeErrorHasItOnlyWhenSmall) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_GT(Nonlinearity(ErrorForm::kMultiplicative, 100 + seed, 1.0), 1e-2);
  }
  // Its Φ is right to first order: the error of Φ falls with the orientation's.
  const auto of = [](double angle) { return Nonlinearity(ErrorForm::kMultiplicative, 100, angle); };
  EXPECT_LT(of(1e-6), 1e-4 * of(1e-2));
}

/// P of θ, v and p after the motion, without noise and with known biases.
template <class Core>
Matrix9 CarriedCovariance(const NavigationState& x, const Matrix9& P0,
                          const std::vector<Input>& motion) {
  ErrorCovariance P = ErrorCovariance::Zero();
  P.topLeftCorner<9, 9>() = P0;
  // Not by Start, which would convert the prior at x: each form starts from the same numbers.
  Core core;
  core.x() = x;
  core.P().Start(P);
  for (const Input& u : motion) core.Propagate({u.w, u.a, kDt}, kDown, {});
  return Matrix9(core.P().Dense().template topLeftCorner<9, 9>());
}

/// The largest difference of what two very different states make of the same priors, in parts of
/// the covariance's largest entry.
template <class Core>
double StateDependence() {
  Draws draws(7);
  const std::vector<Input> motion = RandomMotion(draws);
  NavigationState near, far = draws.State();
  far.v = {-30, 20, 10};
  far.p = {1000, -2000, 500};
  double worst = 0.0;
  for (int i = -1; i < 9; ++i) {
    Matrix9 P0 = Matrix9::Identity();
    if (i >= 0) P0 = Vector9::Unit(i) * Vector9::Unit(i).transpose();
    const Matrix9 a = CarriedCovariance<Core>(near, P0, motion);
    const Matrix9 b = CarriedCovariance<Core>(far, P0, motion);
    worst = std::max(worst, (a - b).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(StateIndependence, OfTheInvariantTransitions) {
  EXPECT_LT(StateDependence<RightInvariantEkf>(), 1e-12);
  EXPECT_LT(StateDependence<LeftInvariantEkf>(), 1e-12);
}

TEST(StateIndependence, NotOfTheMultiplicativeOne) {
  EXPECT_GT(StateDependence<MultiplicativeEkf>(), 0.1);
}

TEST(StateIndependence, TheCovarianceIsThatOfPhi) {
  // Or nothing moved at all.
  Draws draws(8);
  const std::vector<Input> motion = RandomMotion(draws);
  WideMatrix9 Phi = WideMatrix9::Identity();
  for (int i = 0; i < kSteps; ++i) Phi = RightPhi() * Phi;
  const Matrix9 expected = (Phi * Phi.transpose()).cast<double>();
  const Matrix9 P =
      CarriedCovariance<RightInvariantEkf>(draws.State(), Matrix9::Identity(), motion);
  EXPECT_LT((P - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace
}  // namespace reckon::estimator
