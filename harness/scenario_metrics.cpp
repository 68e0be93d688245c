#include "reckon/harness/scenario_metrics.h"

#include "reckon/ground_truth/metrics.h"

namespace reckon::harness {

std::vector<std::string> MetricNames(const std::vector<std::string>& sensors,
                                     const ground_truth::ScoreOptions& options) {
  std::vector<std::string> names;
  const ground_truth::Metrics metrics = ground_truth::MetricCatalogue(sensors, options);
  for (const auto& metric : metrics.list()) names.push_back(metric.name);
  return names;
}

}  // namespace reckon::harness
