#pragma once

#include <span>

#include "reckon/ground_truth/score_options.h"
#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// Moves an estimated trajectory: p ↦ s R p + t, orientation ↦ R R̂, velocity ↦ s R v.
struct Similarity {
  double scale = 1.0;
  models::Pose X;

  models::Pose Apply(const models::Pose& X_WB) const {
    return {X.R * X_WB.R, scale * (X.R * X_WB.p) + X.p};
  }
  Eigen::Vector3d ApplyToVelocity(const Eigen::Vector3d& v_WB) const {
    return scale * (X.R * v_WB);
  }
};

/// What moves the estimates of `samples` onto their truths. kSe3 and kSim3 are Umeyama's least
/// squares over positions (orientations don't count); kYawPosition minimises Σ |p − (Rz(ψ) p̂ + t)|²
/// over ψ and t; kFirstYawPosition turns by the first pose's error in yaw and moves its position.
/// Identity for no samples.
Similarity Align(Alignment alignment, std::span<const TrackSample> samples);

}  // namespace reckon::ground_truth
