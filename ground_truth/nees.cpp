#include "reckon/ground_truth/nees.h"

#include <limits>

#include "reckon/ground_truth/estimate_error.h"

namespace reckon::ground_truth {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// eᵀ P⁻¹ e by LDLᵀ of the lower triangle, column by column: Σ y_j² / d_j with L y = e. A positive
/// definite matrix needs no pivoting.
template <int n>
double NormalisedSquare(Eigen::Matrix<double, n, 1> y, Eigen::Matrix<double, n, n> P,
                        bool* indefinite) {
  double sum = 0.0;
  for (int j = 0; j < n; ++j) {
    const double d = P(j, j);
    if (!(d > 0.0)) {
      *indefinite = true;
      return kNone;
    }
    sum += y[j] * y[j] / d;
    for (int k = j + 1; k < n; ++k) {
      const double factor = P(k, j) / d;
      y[k] -= factor * y[j];
      for (int i = k; i < n; ++i) P(i, k) -= factor * P(i, j);
    }
  }
  return sum;
}

}  // namespace

std::string_view NeesBlockName(int block) {
  constexpr std::array<std::string_view, kNeesBlocks> kNames{
      "orientation", "velocity", "position", "gyro_bias", "accel_bias", "full"};
  return kNames[static_cast<std::size_t>(block)];
}

Nees ComputeNees(const Truth& truth, const estimator::Estimate& estimate) {
  Nees nees;
  nees.value.fill(kNone);
  if (!estimate.has_covariance) return nees;
  const estimator::ErrorVector error = EstimateError(truth, estimate);
  bool all = true;
  for (int block = 0; block < kNeesFull; ++block) {
    const Eigen::Matrix3d P = estimate.covariance.block<3, 3>(3 * block, 3 * block);
    const bool bias = block == kNeesGyroBias || block == kNeesAccelBias;
    if (P.isZero(0.0) || (bias && !(estimate.has_biases && truth.has_biases))) {
      all = false;
      continue;
    }
    const auto index = static_cast<std::size_t>(block);
    nees.estimated[index] = true;
    nees.value[index] = NormalisedSquare<3>(error.segment<3>(3 * block), P, &nees.indefinite);
  }
  nees.estimated[kNeesFull] = all;
  if (all) {
    nees.value[kNeesFull] =
        NormalisedSquare<estimator::kErrorSize>(error, estimate.covariance, &nees.indefinite);
  }
  return nees;
}

}  // namespace reckon::ground_truth
