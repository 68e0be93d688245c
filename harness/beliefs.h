#pragma once

#include <cstdint>

#include "reckon/estimator/setup.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/harness/scenario.h"
#include "reckon/models/suite.h"

namespace reckon::harness {

/// What one estimator is told before its first measurement: the nominal suite, as the scenario lets
/// this estimator believe it, and its numbers.
estimator::Setup MakeSetup(const EstimatorConfig& config, const InitialConfig& initial,
                           const models::Suite& nominal, double gravity_m_s2);

/// The one place where truth becomes belief: the state at the run's start with an error drawn from
/// P₀ in right-invariant coordinates, X̂ = exp(ξ) X and b̂ = b + ζ. The draw depends on the seed
/// alone, so that all estimators of a run start alike. Without `sample_error` the prior starts at
/// truth, with the same P₀.
estimator::Prior DrawPrior(const ground_truth::Truth& truth, const InitialConfig& initial,
                           std::uint64_t seed);

}  // namespace reckon::harness
