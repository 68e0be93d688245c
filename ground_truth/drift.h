#pragma once

#include <span>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// Below this path a run counts as standing: a drift per metre says nothing.
inline constexpr double kStandingPathM = 1.0;

/// How far the estimate is off at the end, after yaw and position of the first pose are aligned
/// (`Alignment::kFirstYawPosition`, whatever alignment the absolute errors use). All NaN without
/// samples.
struct Drift {
  double final_m;
  double final_deg;
  double percent;    ///< 100 · final / path; NaN for a standing run
  double m_per_min;  ///< final error over duration: needs no path
  double deg_per_min;
  double path_m;  ///< accumulated true path
  double duration_s;
};

Drift DriftOf(std::span<const TrackSample> samples);

}  // namespace reckon::ground_truth
