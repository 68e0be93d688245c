#include "reckon/ground_truth/drift.h"

#include <limits>

#include "reckon/ground_truth/alignment.h"
#include "reckon/ground_truth/ate.h"
#include "reckon/ground_truth/rpe.h"

namespace reckon::ground_truth {

Drift DriftOf(std::span<const TrackSample> samples) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (samples.empty()) return {nan, nan, nan, nan, nan, nan, nan};
  const Similarity alignment = Align(Alignment::kFirstYawPosition, samples);
  const AbsoluteErrors error = AbsoluteError(samples.last(1), alignment);
  Drift drift{};
  drift.final_m = error.position_m.front();
  drift.final_deg = error.orientation_deg.front();
  drift.path_m = PathLength(samples);
  drift.duration_s = models::Seconds(samples.back().t_ns - samples.front().t_ns);
  drift.percent = drift.path_m < kStandingPathM ? nan : 100.0 * drift.final_m / drift.path_m;
  const double minutes = drift.duration_s / 60.0;
  drift.m_per_min = minutes > 0.0 ? drift.final_m / minutes : nan;
  drift.deg_per_min = minutes > 0.0 ? drift.final_deg / minutes : nan;
  return drift;
}

}  // namespace reckon::ground_truth
