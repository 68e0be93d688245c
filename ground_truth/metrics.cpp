#include "reckon/ground_truth/metrics.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace reckon::ground_truth {

void Metrics::Add(std::string name, double value, bool applies) {
  list_.push_back({std::move(name), value, applies, "", ""});
}

std::optional<double> Metrics::Find(std::string_view name) const {
  const auto found = std::find_if(list_.begin(), list_.end(),
                                  [name](const Metric& metric) { return metric.name == name; });
  if (found == list_.end() || !std::isfinite(found->value)) return std::nullopt;
  return found->value;
}

bool Metrics::valid() const {
  if (Find("unpaired_estimate_count").value_or(0.0) > 0.0) return false;
  return std::all_of(list_.begin(), list_.end(), [](const Metric& metric) {
    return !metric.applies || std::isfinite(metric.value);
  });
}

nlohmann::ordered_json ToJson(const Metrics& metrics) {
  nlohmann::ordered_json json = {{"valid", metrics.valid()}};
  for (const Metric& metric : metrics.list()) {
    if (!std::isfinite(metric.value)) {
      json[metric.name] = nullptr;
    } else if (metric.unit == "count") {
      json[metric.name] = static_cast<std::int64_t>(metric.value);
    } else {
      json[metric.name] = metric.value;
    }
  }
  return json;
}

}  // namespace reckon::ground_truth
