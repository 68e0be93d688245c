#include "reckon/harness/scenario_metrics.h"

#include "reckon/ground_truth/metrics.h"

namespace reckon::harness {

std::vector<std::string> MetricNames(const std::vector<std::string>& sensors,
                                     const ground_truth::ScoreOptions& options) {
  // The catalogue is what scoring makes, whatever the run: also of one without estimates.
  std::vector<std::string> names;
  for (const auto& metric : ground_truth::Score({}, sensors, options).list()) {
    names.push_back(metric.name);
  }
  return names;
}

}  // namespace reckon::harness
