#include "reckon/estimator/covariance.h"

#include <gtest/gtest.h>

#include "estimator/dense.h"
#include "estimator/draws.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::BySlots;
using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::UsualSigma;
using testing_estimator::WorstCorrelationError;

TEST(Covariance, ANewFootIsThePositionPlusItsNoise) {
  Draws draws(41);
  Covariance P = BySlots(draws.Covariance<15>(UsualSigma()));
  const Matrix3d noise = draws.Covariance<3>(0.01 * Vector3d::Ones());
  P.AddFoot(FootSlot(2), ToLanes(noise));
  P.AddFoot(FootSlot(0), LaneMatrix::Zero());
  const auto block = [&P](Slot i, Slot j) { return ToEigen(P.Get(i, j)); };
  for (const Slot slot :
       {kThetaSlot, kVelocitySlot, kPositionSlot, kGyroBiasSlot, kAccelBiasSlot}) {
    // d = p + R h + noise, and the noise is independent of everything before: copies, bit for bit.
    EXPECT_EQ(block(FootSlot(2), slot), block(kPositionSlot, slot)) << slot;
    EXPECT_EQ(block(slot, FootSlot(0)), block(slot, kPositionSlot)) << slot;
  }
  EXPECT_EQ(block(FootSlot(0), FootSlot(2)), block(kPositionSlot, kPositionSlot));
  EXPECT_EQ(block(FootSlot(2), FootSlot(2)), block(kPositionSlot, kPositionSlot) + noise);
}

TEST(Covariance, AddingAndRemovingAFootIsTheIdentity) {
  Draws draws(42);
  Covariance P = BySlots(draws.Covariance<15>(UsualSigma()));
  const ErrorCovariance before = P.Dense();
  for (const int foot : {3, 0, 1}) P.AddFoot(FootSlot(foot), LaneMatrix::Diagonal(1e-4));
  EXPECT_TRUE(P.IsActive(FootSlot(1)));
  for (const int foot : {0, 3, 1}) P.RemoveFoot(FootSlot(foot));
  EXPECT_EQ(P.active().size(), 5U);
  EXPECT_FALSE(P.IsActive(FootSlot(1)));
  EXPECT_EQ(P.Dense(), before);
}

TEST(KalmanCorrection, OfOneRowIsTheDenseTextbookOne) {
  Draws draws(43);
  for (int i = 0; i < 50; ++i) {
    const ErrorCovariance prior = draws.Covariance<15>(UsualSigma());
    Linearisation<1> m;
    m.z(0) = 0.03;
    m.N(0) = 1e-4;
    m.Block(kThetaSlot, draws.Vector().transpose());
    m.Block(kPositionSlot, Eigen::RowVector3d(0, 0, 1));
    const Eigen::Matrix<Real, 1, 15> H = testing_estimator::DenseH(m);
    const testing_estimator::Mat15 P0 = prior.cast<Real>();
    const Real S = (H * P0 * H.transpose())(0) + m.N(0);
    const Eigen::Matrix<Real, 15, 1> K = P0 * H.transpose() / S;
    const testing_estimator::Mat15 A = testing_estimator::Mat15::Identity() - K * H;
    const testing_estimator::Mat15 expected =
        A * P0 * A.transpose() + K * static_cast<Real>(m.N(0)) * K.transpose();

    Covariance P = BySlots(prior);
    const KalmanCorrection<1> kalman(P, m);
    EXPECT_NEAR(kalman.nis(), static_cast<double>(m.z(0) * m.z(0) / S), 1e-13 * kalman.nis());
    const ErrorVector gain = testing_estimator::DenseIncrement(kalman.Gain());
    kalman.UpdateCovariance(P);
    EXPECT_LT(WorstCorrelationError(P.Dense(), expected), 1e-12);
    const auto deviation = expected.diagonal().cwiseSqrt().cast<double>().eval();
    const ErrorVector miss = gain - (K * static_cast<Real>(m.z(0))).cast<double>();
    EXPECT_LT(miss.cwiseQuotient(deviation).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace reckon::estimator
