#pragma once

#include "reckon/estimator/report.h"
#include "reckon/models/measurement.h"
#include "reckon/models/suite.h"

namespace reckon::estimator {

/// Nobody can say what happened in a longer time without samples. A stamp further ahead than this
/// is refused, so that a broken clock can't carry a filter away.
inline constexpr models::TimeNs kLongestGap = 60 * models::kNsPerSecond;

/// What makes a measurement unusable whatever the filter's state: an unknown sensor or another
/// sensor's sample, numbers that are not finite or beyond any hardware, an interval that is not
/// positive or too long to hold a sample over, a covariance that is not positive definite, a stamp
/// before the run's start or after its arrival. `kNone` if nothing is. Does not allocate.
Refusal WhatIsWrong(const models::Measurement& measurement, const models::Suite& suite);

}  // namespace reckon::estimator
