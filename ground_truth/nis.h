#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reckon/estimator/report.h"
#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// The innovations of one sensor over a run. Rejected ones count like all others: leaving them out
/// would hide an inconsistent filter behind its gate.
struct NisStatistics {
  std::size_t corrections = 0;  ///< how many have a NIS (all but refused ones)
  double mean = 0.0;            ///< time-mean of the NIS; NaN without corrections
  double dof = 0.0;             ///< mean number of rows: what `mean` is if the filter is honest
  /// Whiteness: Σ u_kᵀ u_k+1 / Σ u_kᵀ u_k of the whitened innovations u = L⁻¹ z. An honest filter's
  /// has the mean 0 and the variance 1/(corrections · dof).
  double lag1 = 0.0;
};

NisStatistics NisOf(std::span<const TrackCorrection> corrections, models::SensorId sensor);

inline constexpr std::size_t kDecisions =
    static_cast<std::size_t>(estimator::Decision::kWidened) + 1;
using estimator::kRefusals;

/// What became of one sensor's measurements.
struct DecisionCounts {
  std::array<std::size_t, kDecisions> decisions{};  ///< corrections, by `estimator::Decision`
  std::array<std::size_t, kRefusals> refusals{};    ///< by `estimator::Refusal`: whole or in part
};

DecisionCounts CountDecisions(const Track& track, models::SensorId sensor);

}  // namespace reckon::ground_truth
