#include "reckon/ground_truth/nis.h"

#include <limits>
#include <map>

namespace reckon::ground_truth {
NisStatistics NisOf(std::span<const TrackCorrection> corrections, models::SensorId sensor) {
  NisStatistics statistics;
  std::map<int, const TrackCorrection*> previous;  // by ordinal: like follows like
  double sum = 0.0, rows = 0.0, product = 0.0, power = 0.0;
  for (const TrackCorrection& correction : corrections) {
    if (correction.sensor != sensor || correction.decision == estimator::Decision::kRefused) {
      continue;
    }
    ++statistics.corrections;
    sum += correction.nis;
    rows += correction.rows;
    power += correction.whitened.squaredNorm();
    const TrackCorrection*& last = previous[correction.ordinal];
    if (last != nullptr) product += last->whitened.dot(correction.whitened);
    last = &correction;
  }
  const double n = static_cast<double>(statistics.corrections);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  statistics.mean = n > 0.0 ? sum / n : nan;
  statistics.dof = n > 0.0 ? rows / n : nan;
  statistics.lag1 = power > 0.0 ? product / power : nan;
  return statistics;
}

DecisionCounts CountDecisions(const Track& track, models::SensorId sensor) {
  DecisionCounts counts;
  for (const TrackCorrection& correction : track.corrections()) {
    if (correction.sensor != sensor) continue;
    ++counts.decisions.at(static_cast<std::size_t>(correction.decision));
    if (correction.decision == estimator::Decision::kRefused) {
      ++counts.refusals.at(static_cast<std::size_t>(correction.reason));
    }
  }
  for (const TrackRefusal& refusal : track.refusals()) {
    if (refusal.sensor == sensor) ++counts.refusals.at(static_cast<std::size_t>(refusal.reason));
  }
  return counts;
}

}  // namespace reckon::ground_truth
