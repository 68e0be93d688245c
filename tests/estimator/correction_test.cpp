#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/kalman.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Mat15;
using testing_estimator::Real;
using testing_estimator::UsualSigma;
using testing_estimator::WorstCorrelationError;

using DenseH = Eigen::Matrix<Real, 3, 15>;
using Dense3 = Eigen::Matrix<Real, 3, 3>;

/// A random measurement of velocity and two blocks beside it, with noise of this variance.
Linearisation RandomMeasurement(Draws& draws, double variance) {
  Linearisation m;
  m.z = draws.Vector(0.05);
  m.Add(kVelocity, Matrix3d::Identity());
  m.Add(kGyroBias, Skew(draws.Vector(0.3)));
  m.Add(kTheta, Skew(draws.Vector(0.5)));
  m.N = draws.Covariance<3>(std::sqrt(variance) * Vector3d::Ones());
  return m;
}

struct Textbook {
  Textbook(const ErrorCovariance& prior, const Linearisation& m) {
    H.setZero();
    for (const Block& b : m.blocks()) H.middleCols<3>(b.slot) += b.H.cast<Real>();
    const Mat15 P0 = prior.cast<Real>();
    S = H * P0 * H.transpose() + m.N.cast<Real>();
    K = P0 * H.transpose() * S.inverse();
    const Mat15 A = Mat15::Identity() - K * H;
    P = A * P0 * A.transpose() + K * m.N.cast<Real>() * K.transpose();
  }
  DenseH H;
  Dense3 S;
  Eigen::Matrix<Real, 15, 3> K;
  Mat15 P;
};

TEST(KalmanCorrection, IsTheDenseTextbookOne) {
  Draws draws(21);
  for (int i = 0; i < 50; ++i) {
    ErrorCovariance P = draws.Covariance<15>(UsualSigma());
    const Linearisation m = RandomMeasurement(draws, 1e-4);
    const Textbook expected(P, m);
    const KalmanCorrection kalman(P, m);
    const auto z = m.z.cast<Real>().eval();
    EXPECT_LT(WorstCorrelationError(kalman.S(), expected.S), 1e-14);
    EXPECT_NEAR(kalman.nis(), static_cast<double>(z.dot(expected.S.inverse() * z)),
                1e-13 * kalman.nis());
    const auto gain = (expected.K * z).eval();
    const auto deviation = expected.P.diagonal().cwiseSqrt().eval();
    EXPECT_LT(
        static_cast<double>(
            (kalman.Gain().cast<Real>() - gain).cwiseQuotient(deviation).cwiseAbs().maxCoeff()),
        1e-12);
    kalman.UpdateCovariance(P);
    EXPECT_LT(WorstCorrelationError(P, expected.P), 1e-12);
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
    Linearisation m;
    m.Add(kVelocity, draws.Rotation());
    m.N = draws.Covariance<3>(0.05 / std::sqrt(ratio) * Vector3d::Ones());
    const Textbook expected(P, m);
    update(P, m);
    worst = std::max(worst, WorstCorrelationError(P, expected.P));
  }
  return worst;
}

TEST(KalmanCorrection, KeepsItsDigitsWhenTheMeasurementIsMuchBetterThanThePrior) {
  const auto ours = [](ErrorCovariance& P, const Linearisation& m) {
    KalmanCorrection(ErrorCovariance(P), m).UpdateCovariance(P);
  };
  EXPECT_LT(WorstError(1e2, ours), 1e-12);
  EXPECT_LT(WorstError(1e6, ours), 1e-12);
  EXPECT_LT(WorstError(1e10, ours), 1e-10);
}

TEST(KalmanCorrection, TheShortFormWouldLoseThem) {
  // Negative control: P − K S Kᵀ.
  const auto shorter = [](ErrorCovariance& P, const Linearisation& m) {
    Eigen::Matrix<double, 15, 3> C = Eigen::Matrix<double, 15, 3>::Zero();
    for (const Block& b : m.blocks()) C += P.middleCols<3>(b.slot) * b.H.transpose();
    Matrix3d S = m.N;
    for (const Block& b : m.blocks()) S += b.H * C.middleRows<3>(b.slot);
    P -= C * S.inverse() * C.transpose();
  };
  EXPECT_GT(WorstError(1e10, shorter), 1e-7);
}

TEST(KalmanCorrection, AThousandOfThemStayPositiveDefinite) {
  Draws draws(23);
  ErrorCovariance P = draws.Covariance<15>(UsualSigma());
  for (int i = 0; i < 1000; ++i) {
    const Linearisation m = RandomMeasurement(draws, 1e-12);
    KalmanCorrection(ErrorCovariance(P), m).UpdateCovariance(P);
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
  Linearisation m = RandomMeasurement(draws, 1e-4);
  m.z = Vector3d(3, -2, 1);
  KalmanCorrection kalman(P0, m);
  const double nis = kalman.nis();
  kalman.Inflate(20.0);
  EXPECT_EQ(kalman.nis(), nis) << "the report keeps what was found before the gate";
  // The same correction from scratch, with the noise that makes NIS 20.
  Linearisation widened = m;
  widened.N += (nis / 20.0 - 1.0) * kalman.S();
  const Textbook expected(P0, widened);
  const auto z = m.z.cast<Real>().eval();
  EXPECT_NEAR(static_cast<double>(z.dot(expected.S.inverse() * z)), 20.0, 1e-10);
  ErrorCovariance P = P0;
  kalman.UpdateCovariance(P);
  EXPECT_LT(WorstCorrelationError(P, expected.P), 1e-12);
  EXPECT_LT((kalman.Gain() - (expected.K * z).cast<double>()).norm(), 1e-12);
}

}  // namespace
}  // namespace reckon::estimator
