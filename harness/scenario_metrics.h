#pragma once

#include <string>
#include <vector>

#include "reckon/ground_truth/score_options.h"

namespace reckon::harness {

/// The names of all metrics that a run with these sensors and options scores, whether or not they
/// apply to an estimator.
std::vector<std::string> MetricNames(const std::vector<std::string>& sensors,
                                     const ground_truth::ScoreOptions& options);

}  // namespace reckon::harness
