#include "reckon/ground_truth/nees.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "ground_truth/tracks.h"
#include "reckon/estimator/error_form.h"
#include "reckon/ground_truth/estimate_error.h"

namespace reckon::ground_truth {
namespace {

using estimator::ErrorForm;
using testing::Rot;
using testing::Rz;

constexpr std::array kForms{ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant,
                            ErrorForm::kMultiplicative};

Truth SomeTruth() {
  Truth truth;
  truth.X_WB = {Rot(0.8, {1.0, -2.0, 0.5}), {3.0, -1.0, 2.0}};
  truth.v_WB = {1.0, 0.5, -0.2};
  truth.gyro_bias_rad_s = {0.01, -0.02, 0.03};
  truth.accel_bias_m_s2 = {0.1, 0.2, -0.3};
  return truth;
}

/// The 5×5 matrix of (R, v, p).
Eigen::Matrix<double, 5, 5> Extended(const models::Pose& X, const Eigen::Vector3d& v) {
  Eigen::Matrix<double, 5, 5> m = Eigen::Matrix<double, 5, 5>::Identity();
  m.topLeftCorner<3, 3>() = X.R;
  m.block<3, 1>(0, 3) = v;
  m.block<3, 1>(0, 4) = X.p;
  return m;
}

/// Exp of the wedge of ξ by its power series, scaled and squared.
Eigen::Matrix<double, 5, 5> ExpByPowers(const Eigen::Matrix<double, 9, 1>& xi) {
  Eigen::Matrix<double, 5, 5> wedge = Eigen::Matrix<double, 5, 5>::Zero();
  const Eigen::Vector3d theta = xi.head<3>();
  wedge.topLeftCorner<3, 3>() << 0, -theta.z(), theta.y(), theta.z(), 0, -theta.x(), -theta.y(),
      theta.x(), 0;
  wedge.block<3, 1>(0, 3) = xi.segment<3>(3);
  wedge.block<3, 1>(0, 4) = xi.tail<3>();
  wedge /= 1024.0;
  Eigen::Matrix<double, 5, 5> sum = Eigen::Matrix<double, 5, 5>::Identity(), term = sum;
  for (int n = 1; n < 12; ++n) {
    term = term * wedge / n;
    sum += term;
  }
  for (int k = 0; k < 10; ++k) sum = sum * sum;
  return sum;
}

/// X̂ = Exp(ξ) X (right) or X Exp(ξ) (left): the error must give ξ back, also where it is large.
TEST(EstimateError, IsTheLogarithmOfTheGroupError) {
  for (const double size : {1e-6, 1e-2, 0.3, 1.0}) {
    Eigen::Matrix<double, 9, 1> xi;
    xi << 0.9, -0.5, 0.7, 0.3, -0.8, 0.2, -0.6, 0.4, 1.0;
    xi *= size;
    const Truth truth = SomeTruth();
    const auto X = Extended(truth.X_WB, truth.v_WB);
    for (const ErrorForm form : {ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant}) {
      const Eigen::Matrix<double, 5, 5> hat =
          form == ErrorForm::kRightInvariant ? Eigen::Matrix<double, 5, 5>(ExpByPowers(xi) * X)
                                             : Eigen::Matrix<double, 5, 5>(X * ExpByPowers(xi));
      estimator::Estimate estimate = testing::Exact(truth);
      estimate.form = form;
      estimate.X_WB = {hat.topLeftCorner<3, 3>(), hat.block<3, 1>(0, 4)};
      estimate.v_WB = hat.block<3, 1>(0, 3);
      // Ten squarings double the rounding of the power series ten times: 1e-13.
      EXPECT_LT((EstimateError(truth, estimate).head<9>() - xi).norm(), 1e-12);
    }
  }
}

TEST(EstimateError, MultiplicativeIsPlainInVelocityAndPosition) {
  const Truth truth = SomeTruth();
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.form = ErrorForm::kMultiplicative;
  estimate.X_WB.R = truth.X_WB.R * Rz(0.1);
  estimate.X_WB.p += Eigen::Vector3d(1.0, 2.0, 3.0);
  estimate.v_WB += Eigen::Vector3d(4.0, 5.0, 6.0);
  estimate.gyro_bias_rad_s += Eigen::Vector3d(7.0, 8.0, 9.0);
  estimate.accel_bias_m_s2 += Eigen::Vector3d(-1.0, -2.0, -3.0);
  estimator::ErrorVector expected;
  expected << 0.0, 0.0, 0.1, 4, 5, 6, 1, 2, 3, 7, 8, 9, -1, -2, -3;
  EXPECT_LT((EstimateError(truth, estimate) - expected).norm(), 1e-14);
}

/// Scoring has an implementation of its own; the filters' must mean the same.
TEST(EstimateError, AgreesWithTheFilters) {
  const Truth truth = SomeTruth();
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.X_WB = {truth.X_WB.R * Rot(0.4, {1.0, 1.0, -2.0}), {1.0, 2.0, 3.0}};
  estimate.v_WB = {0.0, 1.0, 1.0};
  estimate.gyro_bias_rad_s = {0.1, 0.2, 0.3};
  const estimator::NavigationState x{truth.X_WB.R, truth.v_WB, truth.X_WB.p, truth.gyro_bias_rad_s,
                                     truth.accel_bias_m_s2};
  const estimator::NavigationState hat{estimate.X_WB.R, estimate.v_WB, estimate.X_WB.p,
                                       estimate.gyro_bias_rad_s, estimate.accel_bias_m_s2};
  for (const ErrorForm form : kForms) {
    estimate.form = form;
    EXPECT_LT((EstimateError(truth, estimate) - estimator::ErrorBetween(form, hat, x)).norm(),
              1e-13);
  }
}

TEST(Nees, OfOneSigmaAnAxisIsItsDof) {
  const Truth truth = SomeTruth();
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.form = ErrorForm::kMultiplicative;
  estimate.has_covariance = estimate.has_biases = true;
  estimate.v_WB += Eigen::Vector3d(0.1, -0.1, 0.1);
  estimate.X_WB.p += Eigen::Vector3d(2.0, 2.0, -2.0);
  estimate.covariance.diagonal() << 1, 1, 1, 0.01, 0.01, 0.01, 4, 4, 4, 1, 1, 1, 1, 1, 1;
  const Nees nees = ComputeNees(truth, estimate);
  EXPECT_NEAR(nees.value[kNeesOrientation], 0.0, 1e-20);
  EXPECT_NEAR(nees.value[kNeesVelocity], 3.0, 1e-12);
  EXPECT_NEAR(nees.value[kNeesPosition], 3.0, 1e-12);
  EXPECT_NEAR(nees.value[kNeesFull], 6.0, 1e-12);
  EXPECT_FALSE(nees.indefinite);
}

/// Errors drawn from a full covariance, with correlations between all blocks and units five orders
/// of magnitude apart: the mean NEES is the number of coordinates, in each form.
TEST(Nees, OfErrorsDrawnFromTheCovarianceHasMeanN) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  estimator::ErrorCovariance L = estimator::ErrorCovariance::Zero();
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j <= i; ++j)
      L(i, j) = (i == j ? 1.0 : 0.3) * std::pow(10.0, -1.0 - 4.0 * i / 15);
  }
  const Truth truth = SomeTruth();
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.has_covariance = estimate.has_biases = true;
  estimate.form = ErrorForm::kRightInvariant;
  estimate.covariance = L * L.transpose();
  constexpr int kDraws = 20000;
  std::array<double, kNeesBlocks> sum{};
  for (int k = 0; k < kDraws; ++k) {
    estimator::ErrorVector unit;
    for (double& entry : unit) entry = normal(generator);
    const estimator::ErrorVector error = L * unit;
    const Eigen::Matrix<double, 5, 5> X =
        ExpByPowers(error.head<9>()) * Extended(truth.X_WB, truth.v_WB);
    estimate.X_WB = {X.topLeftCorner<3, 3>(), X.block<3, 1>(0, 4)};
    estimate.v_WB = X.block<3, 1>(0, 3);
    estimate.gyro_bias_rad_s = truth.gyro_bias_rad_s + error.segment<3>(9);
    estimate.accel_bias_m_s2 = truth.accel_bias_m_s2 + error.segment<3>(12);
    const Nees nees = ComputeNees(truth, estimate);
    for (std::size_t b = 0; b < kNeesBlocks; ++b) sum[b] += nees.value[b];
  }
  for (int b = 0; b < kNeesBlocks; ++b) {
    const double n = NeesDof(b);
    // Five standard deviations of the mean of χ²_n: √(2n / draws).
    EXPECT_NEAR(sum[static_cast<std::size_t>(b)] / kDraws, n, 5.0 * std::sqrt(2.0 * n / kDraws))
        << NeesBlockName(b);
  }
}

TEST(Nees, LeavesOutWhatIsNotEstimated) {
  const Truth truth = SomeTruth();
  estimator::Estimate estimate = testing::Exact(truth);
  EXPECT_TRUE(std::isnan(ComputeNees(truth, estimate).value[kNeesPosition]));  // no covariance
  estimate.has_covariance = estimate.has_biases = true;
  estimate.covariance.diagonal().head<9>().setOnes();  // no biases
  const Nees nees = ComputeNees(truth, estimate);
  EXPECT_EQ(nees.value[kNeesPosition], 0.0);
  EXPECT_FALSE(nees.estimated[kNeesGyroBias]);
  EXPECT_TRUE(std::isnan(nees.value[kNeesGyroBias]) && std::isnan(nees.value[kNeesFull]));
  EXPECT_FALSE(nees.indefinite);
}

TEST(Nees, HasNoBiasesOfAnEstimatorThatGivesNone) {
  const Truth truth;
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.has_covariance = true;
  estimate.has_biases = false;
  estimate.covariance.setIdentity();
  const Nees nees = ComputeNees(truth, estimate);
  EXPECT_TRUE(nees.estimated[kNeesPosition]);
  for (const int block : {kNeesGyroBias, kNeesAccelBias, kNeesFull}) {
    EXPECT_FALSE(nees.estimated[static_cast<std::size_t>(block)]) << block;
  }
}

TEST(Nees, FlagsABrokenCovariance) {
  const Truth truth = SomeTruth();
  for (const double bad : {-1.0, std::nan("")}) {
    estimator::Estimate estimate = testing::Exact(truth);
    estimate.has_covariance = estimate.has_biases = true;
    estimate.covariance.setIdentity();
    estimate.covariance(7, 7) = bad;
    const Nees nees = ComputeNees(truth, estimate);
    EXPECT_TRUE(nees.indefinite);
    EXPECT_TRUE(nees.estimated[kNeesPosition]);
    EXPECT_TRUE(std::isnan(nees.value[kNeesPosition]));
    EXPECT_EQ(nees.value[kNeesVelocity], 0.0);
  }
}

}  // namespace
}  // namespace reckon::ground_truth
