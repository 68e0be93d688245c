#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/depth_model.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/pose_model.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/standstill_model.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::DenseH;
using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::State;
using testing_estimator::Vec15;
using testing_estimator::Vec3;
using testing_estimator::Widened;

using One = Eigen::Matrix<Real, 1, 1>;

template <class Core>
class AidingRows : public ::testing::Test {
 protected:
  /// Expects that the rows of `m` are those by which what a perfect sensor says at the truth behind
  /// an error, less what is expected at the estimate, falls with that error: z = y(x) − y(x̂).
  template <int kRows, class Output>
  void ExpectNumerical(const Linearisation<kRows>& m, const NavigationState& x,
                       const Output& output) {
    const State hat = Widened(x);
    const auto innovation = [&](const Vec15& e) -> Eigen::Matrix<Real, kRows, 1> {
      return output(testing_estimator::TruthBehind(Core::kForm, hat, e)) - output(hat);
    };
    const auto expected = (-testing_estimator::Differences<kRows>(innovation)).eval();
    const auto H = DenseH(Core::Convert(m, x));
    // Differences in long double are good to 1e-14 of positions of some 50 m.
    EXPECT_LT(static_cast<double>((H - expected).cwiseAbs().maxCoeff()), 1e-11);
  }
};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(AidingRows, Cores);

TYPED_TEST(AidingRows, OfDepthAreTheNumericalOnes) {
  Draws draws(41);
  for (int i = 0; i < 20; ++i) {
    const NavigationState x = draws.State();
    const Vector3d r = draws.Vector(0.5);
    const auto height = [&](const State& s) -> One {
      return One((s.p + s.R * r.cast<Real>()).z());
    };
    const double depth = -(x.p + x.R * r).z();
    const auto m = LinearisedDepth({depth}, r, 0.1, x);
    EXPECT_NEAR(m.z(0), 0.0, 1e-14);
    this->ExpectNumerical(m, x, height);
  }
}

TYPED_TEST(AidingRows, OfPositionAreTheNumericalOnes) {
  Draws draws(42);
  for (int i = 0; i < 20; ++i) {
    const NavigationState x = draws.State();
    const models::Pose X_IS{draws.Rotation(), draws.Vector(0.5)};
    models::PoseSample y;
    y.X_WS = models::Pose{x.R, x.p} * X_IS;
    const auto m = LinearisedPosition(y, X_IS, 1.0, x);
    EXPECT_LT(m.z.norm(), 1e-13);
    this->ExpectNumerical(m, x,
                          [&](const State& s) -> Vec3 { return s.p + s.R * X_IS.p.cast<Real>(); });
  }
}

TYPED_TEST(AidingRows, OfYawAreTheNumericalOnes) {
  Draws draws(43);
  int tested = 0;
  for (int i = 0; i < 60; ++i) {
    const NavigationState x = draws.State();
    const models::Pose X_IS{draws.Rotation(), draws.Vector(0.5)};
    models::PoseSample y;
    y.X_WS = models::Pose{x.R, x.p} * X_IS;
    const auto m = LinearisedYaw(y, X_IS, 1.0, x);
    const Vector3d axis = y.X_WS.R.col(0);
    ASSERT_EQ(m.has_value(), axis.head<2>().norm() > 0.17) << "only steep axes are left out";
    // At a jump of the angle differences mean nothing; steep axes enlarge their error.
    if (!m || std::abs(std::atan2(axis.y(), axis.x())) > 3.0 || std::abs(axis.z()) > 0.9) continue;
    ++tested;
    this->ExpectNumerical(*m, x, [&](const State& s) -> One {
      const Vec3 direction = s.R * X_IS.R.col(0).cast<Real>();
      return One(std::atan2(direction.y(), direction.x()));
    });
  }
  EXPECT_GT(tested, 30);
}

TYPED_TEST(AidingRows, OfStandstillAreTheNumericalOnes) {
  Draws draws(44);
  for (int i = 0; i < 20; ++i) {
    NavigationState x = draws.State();
    const Vector3d w = draws.Vector(0.02);
    this->ExpectNumerical(LinearisedZeroRate(w, 1.0, x), x,
                          [](const State& s) -> Vec3 { return s.bg; });
    x.v.setZero();  // the row holds where the measurement does: elsewhere it turns with θ
    this->ExpectNumerical(LinearisedZeroVelocity(0.01, x), x,
                          [](const State& s) -> Vec3 { return s.v; });
  }
}

TEST(DepthModel, FollowsTheFieldsRow) {
  // At (3, 4, −10) with the sensor 2 m below: a turn about x lifts what lies at y, and so on.
  NavigationState x;
  x.p = {3, 4, -10};
  const auto m = LinearisedDepth({11.5}, {0, 0, -2}, 0.25, x);
  EXPECT_DOUBLE_EQ(m.z(0), 0.5) << "believed at −12, measured at −11.5";
  EXPECT_DOUBLE_EQ(m.N(0), 0.0625);
  const auto H = DenseH(m);
  EXPECT_EQ(H.leftCols(3).cast<double>(), Eigen::RowVector3d(4, -3, 0));
  EXPECT_EQ(H.middleCols(6, 3).cast<double>(), Eigen::RowVector3d(0, 0, 1));
}

/// One depth correction as Potokar et al. have it: the left-invariant pseudo-measurement of all of
/// the position, with infinite variance in its horizontal axes; here with a large one.
TEST(DepthModel, IsTheLimitOfInfiniteHorizontalVariance) {
  Draws draws(45);
  for (int i = 0; i < 10; ++i) {
    const NavigationState x = draws.State();
    const ErrorCovariance P = draws.Covariance<15>(testing_estimator::UsualSigma());
    const Vector3d r = draws.Vector(0.5);
    const Vector3d q = x.p + x.R * r;
    const auto row = LinearisedDepth({-q.z() - 0.3}, r, 0.2, x);
    Linearisation<3> whole;
    whole.z = {0, 0, 0.3};
    whole.N = Vector3d(1e9, 1e9, 0.04).asDiagonal();
    whole.Block(kThetaSlot, -Skew(q));
    whole.Plus(kPositionSlot);
    Covariance a = testing_estimator::BySlots(P), b = a;
    const KalmanCorrection<1> one(a, row);
    const KalmanCorrection<3> three(b, whole);
    const ErrorVector gain = testing_estimator::DenseIncrement(one.Gain());
    const ErrorVector limit = testing_estimator::DenseIncrement(three.Gain());
    // Variances of some 400 m² against 1e9 m².
    EXPECT_LT((gain - limit).cwiseQuotient(P.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(), 1e-5);
    one.UpdateCovariance(a);
    three.UpdateCovariance(b);
    EXPECT_LT(testing_estimator::WorstCorrelationError(a.Dense(), b.Dense()), 1e-5);
  }
}

TEST(YawModel, TakesTheShortWayRound) {
  NavigationState x;
  x.R = Exp({0, 0, std::numbers::pi - 0.1});
  models::PoseSample y;
  y.X_WS.R = Exp({0, 0, -std::numbers::pi + 0.2});
  y.orientation_sigma_rad = {1, 1, 0.5};
  const auto m = LinearisedYaw(y, {}, 2.0, x);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->z(0), 0.3, 1e-14);
  EXPECT_DOUBLE_EQ(m->N(0), 1.0) << "twice the sigma that was delivered";
  y.has_orientation = false;
  EXPECT_FALSE(LinearisedYaw(y, {}, 1.0, x));
}

TEST(YawModel, IsBlindToTheTiltOfTheSample) {
  // A compass that believes in level ground, on a robot that pitches by 20°.
  NavigationState x;
  x.R = Exp({0, 0, 0.7}) * Exp({0, 0.35, 0});
  models::PoseSample y;
  y.X_WS.R = Exp({0, 0, 0.7});
  EXPECT_NEAR(LinearisedYaw(y, {}, 1.0, x)->z(0), 0.0, 1e-15);
}

TEST(PositionModel, ScalesTheSigmaThatIsDelivered) {
  models::PoseSample y;
  y.X_WS.p = {1, 2, 3};
  y.position_sigma_m = {0.1, 0.2, 0.3};
  const auto m = LinearisedPosition(y, {}, 2.0, {});
  EXPECT_EQ(m.z, Vector3d(1, 2, 3));
  EXPECT_LT((m.N.diagonal() - Vector3d(0.04, 0.16, 0.36)).norm(), 1e-15);
}

TEST(StandstillModel, ComparesWithZeroAndWithTheBias) {
  NavigationState x;
  x.v = {0.1, -0.2, 0.3};
  x.gyro_bias = {0.01, 0.02, 0.03};
  EXPECT_EQ(LinearisedZeroVelocity(0.5, x).z, Vector3d(-0.1, 0.2, -0.3));
  EXPECT_EQ(LinearisedZeroVelocity(0.5, x).N(1, 1), 0.25);
  const auto rate = LinearisedZeroRate({0.03, 0.03, 0.03}, 1e-6, x);
  EXPECT_LT((rate.z - Vector3d(0.02, 0.01, 0)).norm(), 1e-17);
  EXPECT_EQ(rate.N(2, 2), 1e-6);
}

}  // namespace
}  // namespace reckon::estimator
