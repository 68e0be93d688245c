#include "reckon/ground_truth/nees.h"

#include <Eigen/Cholesky>
#include <limits>

#include "reckon/ground_truth/estimate_error.h"

namespace reckon::ground_truth {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// eᵀ P⁻¹ e by LDLᵀ of the lower triangle.
template <int n>
double BlockNees(const Eigen::Matrix<double, n, 1>& e, const Eigen::Matrix<double, n, n>& P,
                 bool* indefinite) {
  const Eigen::LDLT<Eigen::Matrix<double, n, n>> ldlt(P);
  const bool definite = ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 0.0;
  if (!definite) *indefinite = true;
  return definite ? e.dot(ldlt.solve(e)) : kNone;
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
    if (P.isZero(0.0)) {
      all = false;
      continue;
    }
    const auto index = static_cast<std::size_t>(block);
    nees.estimated[index] = true;
    nees.value[index] = BlockNees<3>(error.segment<3>(3 * block), P, &nees.indefinite);
  }
  nees.estimated[kNeesFull] = all;
  if (all) {
    nees.value[kNeesFull] =
        BlockNees<estimator::kErrorSize>(error, estimate.covariance, &nees.indefinite);
  }
  return nees;
}

}  // namespace reckon::ground_truth
