#pragma once

#include <string>
#include <vector>

#include "reckon/ground_truth/score_options.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// The names of all metrics that a run with these sensors, options and feet scores, whether or not
/// they apply to an estimator.
std::vector<std::string> MetricNames(const std::vector<std::string>& sensors,
                                     const ground_truth::ScoreOptions& options,
                                     const std::vector<std::string>& feet);

/// The feet of the simulated robot, links in the order of its legs; empty if it has none.
std::vector<std::string> FeetOf(const Scenario& scenario);

}  // namespace reckon::harness
