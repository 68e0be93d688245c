#pragma once

#include <span>
#include <vector>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// Errors that no alignment touches, one entry a sample: of what a robot's own controller uses.
struct BodyErrors {
  std::vector<double> tilt_deg;      ///< angle between the two up directions, in the body
  std::vector<double> heading_deg;   ///< |twist about W's z| of R̂ Rᵀ
  std::vector<double> velocity_m_s;  ///< |R̂ᵀ v̂ − Rᵀ v|: in each one's own body axes
};
BodyErrors BodyError(std::span<const TrackSample> samples);

}  // namespace reckon::ground_truth
