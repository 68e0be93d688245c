#include "reckon/harness/scenario_metrics.h"

#include "reckon/ground_truth/metrics.h"

namespace reckon::harness {

std::vector<std::string> MetricNames(const std::vector<std::string>& sensors,
                                     const ground_truth::ScoreOptions& options,
                                     const std::vector<std::string>& feet) {
  std::vector<std::string> names;
  const ground_truth::Metrics metrics = ground_truth::MetricCatalogue(sensors, options, feet);
  for (const auto& metric : metrics.list()) names.push_back(metric.name);
  return names;
}

std::vector<std::string> FeetOf(const Scenario& scenario) {
  const auto* legged = std::get_if<sim::LeggedConfig>(&scenario.drive);
  return legged != nullptr && scenario.log.empty() ? legged->feet : std::vector<std::string>();
}

}  // namespace reckon::harness
