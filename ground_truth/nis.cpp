#include "reckon/ground_truth/nis.h"

#include <algorithm>
#include <limits>
#include <map>

namespace reckon::ground_truth {
namespace {

/// The longest correlation that is looked for.
constexpr std::size_t kMaxLag = 1000;

/// τ of a series: how many of its values tell as much about the mean as one independent value.
double CorrelationTime(const std::vector<double>& series, double mean) {
  const std::size_t n = series.size();
  double variance = 0.0;
  for (const double value : series) variance += (value - mean) * (value - mean);
  if (!(variance > 0.0)) return 1.0;
  double tau = 1.0;
  for (std::size_t lag = 1; lag < std::min(kMaxLag, n / 4); ++lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < n; ++k) sum += (series[k] - mean) * (series[k + lag] - mean);
    if (sum <= 0.0) break;
    tau += 2.0 * sum / variance;
  }
  return tau;
}

}  // namespace

NisStatistics NisOf(std::span<const TrackCorrection> corrections, models::SensorId sensor) {
  std::vector<double> series;
  std::map<int, const TrackCorrection*> previous;  // by ordinal: like follows like
  double sum = 0.0, rows = 0.0, product = 0.0, power = 0.0;
  for (const TrackCorrection& correction : corrections) {
    if (correction.sensor != sensor || correction.decision == estimator::Decision::kRefused) {
      continue;
    }
    series.push_back(correction.nis);
    sum += correction.nis;
    rows += correction.rows;
    power += correction.whitened.squaredNorm();
    const TrackCorrection*& last = previous[correction.ordinal];
    if (last != nullptr) product += last->whitened.dot(correction.whitened);
    last = &correction;
  }
  NisStatistics statistics;
  statistics.corrections = series.size();
  const double n = static_cast<double>(series.size());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  statistics.mean = series.empty() ? nan : sum / n;
  statistics.dof = series.empty() ? nan : rows / n;
  statistics.lag1 = power > 0.0 ? product / power : nan;
  statistics.independent = series.empty() ? 0.0 : n / CorrelationTime(series, statistics.mean);
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
