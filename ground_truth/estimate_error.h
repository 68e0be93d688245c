#pragma once

#include "reckon/estimator/estimate.h"
#include "reckon/ground_truth/truth.h"

namespace reckon::ground_truth {

/// The error of `estimate` in the coordinates of its own covariance (`estimator::ErrorForm`).
estimator::ErrorVector EstimateError(const Truth& truth, const estimator::Estimate& estimate);

}  // namespace reckon::ground_truth
