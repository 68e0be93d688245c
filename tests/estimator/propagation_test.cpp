#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "estimator/dense_legged.h"
#include "estimator/draws.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Mat15;
using testing_estimator::Real;
using testing_estimator::UsualSigma;
using testing_estimator::Vec15;
using testing_estimator::Vec3;
using testing_estimator::Widened;

constexpr double kGravity = 9.81;
const Vector3d kDown(0, 0, -kGravity);

/// One random step: where the filter is, what its IMU reads, for how long.
struct Case {
  explicit Case(Draws& draws, double dt_s)
      : x(draws.State()),
        gyro(draws.Vector(1.5)),
        accel(draws.Vector(10.0)),
        dt(dt_s),
        P(draws.Covariance<15>(UsualSigma())) {}

  Increment Sample() const { return {gyro - x.gyro_bias, accel - x.accel_bias, dt}; }

  NavigationState x;
  Vector3d gyro, accel;
  double dt;
  ErrorCovariance P;
};

/// Steps from a fast IMU to a bridged gap; the last takes the series past its switch.
constexpr double kSteps[] = {0.002, 0.005, 0.01, 0.4};

/// A core that holds exactly `P` in its own coordinates.
template <class Core>
Core At(const NavigationState& x, const ErrorCovariance& P) {
  Core core;
  core.Start(x, ErrorCovariance::Zero());
  core.P().Start(P);
  return core;
}

template <class Core>
class Propagation : public ::testing::Test {};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(Propagation, Cores);

TYPED_TEST(Propagation, MovesTheMeanAsTheTextbookDoes) {
  Draws draws(11);
  for (const double dt : kSteps) {
    const Case c(draws, dt);
    auto core = At<TypeParam>(c.x, c.P);
    core.Propagate(c.Sample(), kDown, {});
    const auto next = testing_estimator::Step(Widened(c.x), c.gyro.cast<Real>(),
                                              c.accel.cast<Real>(), dt, kGravity);
    const auto moved = Widened(core.x());
    // Round-off of positions of some 50 m.
    EXPECT_LT(static_cast<double>((moved.R - next.R).norm()), 3e-15);
    EXPECT_LT(static_cast<double>((moved.v - next.v).norm()), 2e-14);
    EXPECT_LT(static_cast<double>((moved.p - next.p).norm()), 4e-14);
  }
}

TYPED_TEST(Propagation, CovarianceIsTheDenseTextbookOfNumericalJacobians) {
  Draws draws(12);
  const ProcessNoise noise{4e-6, 1e-4, 1e-8, 1e-6};
  for (const double dt : kSteps) {
    for (int i = 0; i < 5; ++i) {
      const Case c(draws, dt);
      auto core = At<TypeParam>(c.x, c.P);
      core.Propagate(c.Sample(), kDown, noise);
      testing_estimator::LeggedBelief expected{
          TypeParam::kForm, {Widened(c.x), {}}, c.P.cast<Real>()};
      expected.Propagate(c.gyro.cast<Real>(), c.accel.cast<Real>(), dt, kGravity, noise);
      EXPECT_LT(testing_estimator::WorstCorrelationError(core.P().Dense(), expected.P), 1e-12)
          << dt;
    }
  }
}

TYPED_TEST(Propagation, StepNoiseIsTheQuadratureOverTheHeldSample) {
  Draws draws(13);
  const double dt = 0.005;
  const ProcessNoise noise{1e-8, 1e-6, 0.0, 0.0};
  const Case c(draws, dt);
  auto core = At<TypeParam>(c.x, ErrorCovariance::Zero());
  core.Propagate(c.Sample(), kDown, noise);
  // Six-dimensional cubature of degree three: points at ±√6 σ on each axis.
  const auto hat = testing_estimator::Step(Widened(c.x), c.gyro.cast<Real>(), c.accel.cast<Real>(),
                                           dt, kGravity);
  Mat15 expected = Mat15::Zero();
  for (int axis = 0; axis < 6; ++axis) {
    const double sigma = std::sqrt((axis < 3 ? noise.gyro : noise.accel) / dt);
    for (const double sign : {-1.0, 1.0}) {
      Vec3 n_g = Vec3::Zero(), n_a = Vec3::Zero();
      (axis < 3 ? n_g : n_a)[axis % 3] = sign * std::sqrt(6.0) * sigma;
      // The sample read is the true one plus its noise.
      const auto truth = testing_estimator::Step(Widened(c.x), c.gyro.cast<Real>() - n_g,
                                                 c.accel.cast<Real>() - n_a, dt, kGravity);
      const Vec15 e = testing_estimator::Error(TypeParam::kForm, hat, truth);
      expected += e * e.transpose() / 12.0L;
    }
  }
  // The quadrature sees the curvature of the step: (σ Δt)² relative, and the second-order part of
  // the coordinates, larger in position where the state is tens of metres from the origin.
  for (const int block : {0, 3, 6}) {
    const Eigen::Matrix3d ours = core.P().Dense().template block<3, 3>(block, block);
    const Eigen::Matrix3d theirs =
        expected.template block<3, 3>(block, block).template cast<double>();
    EXPECT_LT((ours - theirs).norm(), 1e-8 * theirs.norm()) << block;
  }
}

TYPED_TEST(Propagation, StaysSymmetricAndPositiveDefinite) {
  Draws draws(14);
  Case c(draws, 0.005);
  auto core = At<TypeParam>(c.x, c.P);
  const ProcessNoise noise{4e-8, 1e-6, 1e-10, 1e-8};
  for (int i = 0; i < 2000; ++i) {
    const Vector3d gyro = draws.Vector(0.5);
    const Vector3d hover = core.x().R.transpose() * Vector3d(0, 0, kGravity);
    core.Propagate({gyro, hover + draws.Vector(), c.dt}, kDown, noise);
  }
  const ErrorCovariance P = core.P().Dense();
  EXPECT_LT((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-12 * P.diagonal().maxCoeff());
  const Vec15 scale = P.diagonal().cwiseSqrt().cwiseInverse().template cast<Real>();
  const Mat15 correlation = scale.asDiagonal() * P.template cast<Real>() * scale.asDiagonal();
  EXPECT_EQ(Eigen::LLT<Mat15>(correlation).info(), Eigen::Success);
  EXPECT_LT((core.x().R.transpose() * core.x().R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

/// The top-left 9×9 of Φ: a prior with unit variance in direction j alone becomes φ_j φ_jᵀ, and
/// φ_jj is positive.
template <class Core>
Eigen::Matrix<double, 9, 9> TopLeftOfPhi(const Case& c) {
  Eigen::Matrix<double, 9, 9> Phi;
  for (int j = 0; j < 9; ++j) {
    ErrorCovariance P = ErrorCovariance::Zero();
    P(j, j) = 1.0;
    auto core = At<Core>(c.x, P);
    core.Propagate(c.Sample(), kDown, {});
    P = core.P().Dense();
    Phi.col(j) = P.block<9, 1>(0, j) / std::sqrt(P(j, j));
  }
  return Phi;
}

TEST(RightInvariant, TopLeftOfPhiDoesNotDependOnTheState) {
  Draws draws(15);
  const Case first(draws, 0.01);
  const Eigen::Matrix<double, 9, 9> Phi = TopLeftOfPhi<RightInvariantEkf>(first);
  for (int i = 0; i < 20; ++i) {
    const Case other(draws, 0.01);
    // Bit for bit: no state enters.
    EXPECT_EQ(TopLeftOfPhi<RightInvariantEkf>(other), Phi);
  }
  const Case moved(draws, 0.01);
  EXPECT_GT((TopLeftOfPhi<MultiplicativeEkf>(moved) - TopLeftOfPhi<MultiplicativeEkf>(first))
                .cwiseAbs()
                .maxCoeff(),
            1e-3)
      << "the multiplicative error's transition is the negative control";
}

TEST(RightInvariant, ErrorIsLogLinearHoweverLarge) {
  // Without bias error and noise, ξ⁺ = Φ ξ exactly (Theorem 2 of Barrau and Bonnabel), here from
  // 100° of orientation and 10 m/s of velocity error.
  Draws draws(16);
  using testing_estimator::State;
  const Real dt = 0.01L, g = kGravity;
  Vec15 xi = Vec15::Zero();
  xi.segment<3>(kTheta) = 1.75L * draws.Vector().normalized().cast<Real>();
  xi.segment<3>(kVelocity) = draws.Vector(10.0).cast<Real>();
  xi.segment<3>(kPosition) = draws.Vector(10.0).cast<Real>();
  State x = Widened(draws.State());
  x.bg.setZero();
  x.ba.setZero();
  State hat = testing_estimator::Erring(ErrorForm::kRightInvariant, x, xi);
  Case c(draws, 0.01);
  Eigen::Matrix<Real, 9, 9> Phi = TopLeftOfPhi<RightInvariantEkf>(c).cast<Real>();
  Eigen::Matrix<Real, 9, 1> expected = xi.head<9>();
  for (int i = 0; i < 100; ++i) {
    const Vec3 gyro = draws.Vector().cast<Real>(), accel = draws.Vector(10.0).cast<Real>();
    x = testing_estimator::Step(x, gyro, accel, dt, g);
    hat = testing_estimator::Step(hat, gyro, accel, dt, g);
    expected = Phi * expected;
  }
  const Vec15 error = testing_estimator::Error(ErrorForm::kRightInvariant, hat, x);
  // Φ was read off a double-precision filter.
  EXPECT_LT(static_cast<double>((error.head<9>() - expected).norm()), 1e-12 * 100.0);
}

}  // namespace
}  // namespace reckon::estimator
