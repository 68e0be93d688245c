#pragma once

#include <array>
#include <string_view>

#include "reckon/estimator/estimate.h"
#include "reckon/ground_truth/truth.h"

namespace reckon::ground_truth {

/// The blocks whose normalised error squared is scored: five of three coordinates, and all fifteen.
enum NeesBlock : int {
  kNeesOrientation,
  kNeesVelocity,
  kNeesPosition,
  kNeesGyroBias,
  kNeesAccelBias,
  kNeesFull
};
inline constexpr int kNeesBlocks = 6;

/// `orientation`, `velocity`, … : as in the metrics' names.
std::string_view NeesBlockName(int block);

/// Coordinates of a block: 3, and 15 for all.
constexpr int NeesDof(int block) { return block == kNeesFull ? estimator::kErrorSize : 3; }

/// NEES = eᵀ P⁻¹ e per block, NaN where there is none.
struct Nees {
  std::array<double, kNeesBlocks> value;
  std::array<bool, kNeesBlocks> estimated{};  ///< whether there is a covariance to judge by
  bool indefinite = false;  ///< a block's covariance is not positive definite: a broken filter
};

/// The NEES of `estimate` in its own error form, never aligned: unknown yaw and position are judged
/// by the prior's covariance. A block whose covariance is exactly zero is not estimated and has
/// none; so have biases that the estimator or the truth has not, and every block of an estimate
/// without covariance. Does not allocate.
Nees ComputeNees(const Truth& truth, const estimator::Estimate& estimate);

}  // namespace reckon::ground_truth
