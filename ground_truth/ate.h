#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reckon/ground_truth/alignment.h"
#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// |Log R| [rad], in [0, π].
double RotationAngle(const Eigen::Matrix3d& R);

/// Absolute errors at each sample after alignment [Sturm12; Zhang18]: |p − p̂′|, |Log(Rᵀ R̂′)| and
/// |v − v̂′|.
struct AbsoluteErrors {
  std::vector<double> position_m, orientation_deg, velocity_m_s;
};

AbsoluteErrors AbsoluteError(std::span<const TrackSample> samples, const Similarity& alignment);

}  // namespace reckon::ground_truth
