#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/kalman.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::BySlots;
using testing_estimator::DenseH;
using testing_estimator::DenseIncrement;
using testing_estimator::Draws;
using testing_estimator::Mat15;
using testing_estimator::Real;
using testing_estimator::UsualSigma;
using testing_estimator::WorstCorrelationError;

using Dense3 = Eigen::Matrix<Real, 3, 3>;

/// A random measurement of velocity less position, and two blocks beside them, with noise of this
/// variance.
Linearisation<3> RandomMeasurement(Draws& draws, double variance) {
  Linearisation<3> m;
  m.z = draws.Vector(0.05);
  m.Plus(kVelocitySlot);
  m.Minus(kPositionSlot);
  m.Block(kGyroBiasSlot, Skew(draws.Vector(0.3)));
  m.Block(kThetaSlot, Skew(draws.Vector(0.5)));
  m.N = draws.Covariance<3>(std::sqrt(variance) * Vector3d::Ones());
  return m;
}

struct Textbook {
  Textbook(const ErrorCovariance& prior, const Linearisation<3>& m) {
    H = DenseH(m);
    const Mat15 P0 = prior.cast<Real>();
    S = H * P0 * H.transpose() + m.N.cast<Real>();
    K = P0 * H.transpose() * S.inverse();
    const Mat15 A = Mat15::Identity() - K * H;
    P = A * P0 * A.transpose() + K * m.N.cast<Real>() * K.transpose();
  }
  Eigen::Matrix<Real, 3, 15> H;
  Dense3 S;
  Eigen::Matrix<Real, 15, 3> K;
  Mat15 P;
};

TEST(KalmanCorrection, IsTheDenseTextbookOne) {
  Draws draws(21);
  for (int i = 0; i < 50; ++i) {
    ErrorCovariance P = draws.Covariance<15>(UsualSigma());
    const Linearisation<3> m = RandomMeasurement(draws, 1e-4);
    const Textbook expected(P, m);
    Covariance slots = BySlots(P);
    const KalmanCorrection kalman(slots, m);
    const auto z = m.z.cast<Real>().eval();
    EXPECT_LT(WorstCorrelationError(kalman.S(), expected.S), 1e-14);
    EXPECT_NEAR(kalman.nis(), static_cast<double>(z.dot(expected.S.inverse() * z)),
                1e-13 * kalman.nis());
    const auto gain = (expected.K * z).eval();
    const auto deviation = expected.P.diagonal().cwiseSqrt().eval();
    EXPECT_LT(static_cast<double>((DenseIncrement(kalman.Gain()).cast<Real>() - gain)
                                      .cwiseQuotient(deviation)
                                      .cwiseAbs()
                                      .maxCoeff()),
              1e-12);
    kalman.UpdateCovariance(slots);
    EXPECT_LT(WorstCorrelationError(slots.Dense(), expected.P), 1e-12);
  }
}

/// The worst error of one velocity update over random cases, for a prior variance so many times the
/// noise. Velocity alone is measured, so that its posterior is as small as the noise.
template <class Update>
double WorstError(double ratio, const Update& update) {
  Draws draws(22);
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) {
    ErrorCovariance P = draws.Covariance<15>(UsualSigma());
    Linearisation<3> m;
    m.Block(kVelocitySlot, draws.Rotation());
    m.N = draws.Covariance<3>(0.05 / std::sqrt(ratio) * Vector3d::Ones());
    const Textbook expected(P, m);
    update(P, m);
    worst = std::max(worst, WorstCorrelationError(P, expected.P));
  }
  return worst;
}

TEST(KalmanCorrection, KeepsItsDigitsWhenTheMeasurementIsMuchBetterThanThePrior) {
  const auto ours = [](ErrorCovariance& P, const Linearisation<3>& m) {
    Covariance slots = BySlots(P);
    KalmanCorrection(slots, m).UpdateCovariance(slots);
    P = slots.Dense();
  };
  EXPECT_LT(WorstError(1e2, ours), 1e-12);
  EXPECT_LT(WorstError(1e6, ours), 1e-12);
  EXPECT_LT(WorstError(1e10, ours), 1e-10);
}

TEST(KalmanCorrection, TheShortFormWouldLoseThem) {
  // Negative control: P − K S Kᵀ.
  const auto shorter = [](ErrorCovariance& P, const Linearisation<3>& m) {
    const Eigen::Matrix<double, 3, 15> H = DenseH(m).cast<double>();
    const Eigen::Matrix<double, 15, 3> C = P * H.transpose();
    const Matrix3d S = H * C + m.N;
    P -= C * S.inverse() * C.transpose();
  };
  EXPECT_GT(WorstError(1e10, shorter), 1e-7);
}

TEST(KalmanCorrection, AThousandOfThemStayPositiveDefinite) {
  Draws draws(23);
  ErrorCovariance P = draws.Covariance<15>(UsualSigma());
  for (int i = 0; i < 1000; ++i) {
    const Linearisation<3> m = RandomMeasurement(draws, 1e-12);
    Covariance slots = BySlots(P);
    KalmanCorrection(slots, m).UpdateCovariance(slots);
    P = slots.Dense();
    P.diagonal() += 1e-3 * UsualSigma().cwiseAbs2();
  }
  EXPECT_EQ(P, P.transpose());
  const Eigen::Matrix<double, 15, 1> scale = P.diagonal().cwiseSqrt().cwiseInverse();
  const ErrorCovariance correlation = scale.asDiagonal() * P * scale.asDiagonal();
  EXPECT_EQ(Eigen::LLT<ErrorCovariance>(correlation).info(), Eigen::Success);
}

TEST(KalmanCorrection, InflatingPutsTheInnovationOnTheGatesEdge) {
  Draws draws(24);
  const ErrorCovariance P0 = draws.Covariance<15>(UsualSigma());
  Linearisation<3> m = RandomMeasurement(draws, 1e-4);
  m.z = Vector3d(3, -2, 1);
  Covariance slots = BySlots(P0);
  KalmanCorrection kalman(slots, m);
  const double nis = kalman.nis();
  kalman.Inflate(20.0);
  EXPECT_EQ(kalman.nis(), nis) << "the report keeps what was found before the gate";
  // The same correction from scratch, with the noise that makes NIS 20.
  Linearisation<3> widened = m;
  widened.N += (nis / 20.0 - 1.0) * kalman.S();
  const Textbook expected(P0, widened);
  const auto z = m.z.cast<Real>().eval();
  EXPECT_NEAR(static_cast<double>(z.dot(expected.S.inverse() * z)), 20.0, 1e-10);
  const ErrorVector gain = DenseIncrement(kalman.Gain());
  kalman.UpdateCovariance(slots);
  EXPECT_LT(WorstCorrelationError(slots.Dense(), expected.P), 1e-12);
  EXPECT_LT((gain - (expected.K * z).cast<double>()).norm(), 1e-12);
}

}  // namespace
}  // namespace reckon::estimator
