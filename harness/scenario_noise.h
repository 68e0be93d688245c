#pragma once

#include "reckon/estimator/setup.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// The noise that a filter would believe if it knew the sensors of `scenario` (`noise: matched`),
/// as far as they say it. From the first IMU, for each triad:
///   density² = noise density² + resolution² / (12 rate)              white, with quantisation
///   walk²    = random walk² + 2 σ_B² / τ                             the process that drives a
///                                                                    Gauss-Markov bias
/// Body velocity and pose: scale 1, since these sensors deliver their covariance. From the first
/// depth sensor: σ² = noise² + resolution² / 12; its constant offset is no white noise. What the
/// ground does to wheels is no sensor's error: those numbers stay nominal.
estimator::Noise MatchedNoise(const Scenario& scenario);

}  // namespace reckon::harness
