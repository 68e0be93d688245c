#include "reckon/harness/remarks.h"

#include <fmt/format.h>

#include <string_view>

namespace reckon::harness {
namespace {

/// A gate at its default rejects one honest correction in 10,000: this many are no chance.
constexpr double kRejectedShare = 0.01;

/// The middle of `name` if it starts and ends so.
std::string_view Between(std::string_view name, std::string_view start, std::string_view end) {
  if (!name.starts_with(start) || !name.ends_with(end)) return {};
  return name.substr(start.size(), name.size() - start.size() - end.size());
}

double Count(const ground_truth::Metrics& metrics, const std::string& name) {
  return metrics.Find(name).value_or(0.0);
}

/// Measurements that were refused as a whole; before the start that is what filters do.
void AddRefusals(const EstimatorScore& score, bool started, std::vector<std::string>& remarks) {
  for (const auto& metric : score.metrics.list()) {
    const std::string_view what = Between(metric.name, "refused_", "_count");
    if (what.empty() || !(metric.value > 0.0)) continue;
    const bool before_start = what.ends_with("_not_initialised") || what.ends_with("_moving");
    if (before_start && started) continue;
    remarks.push_back(
        fmt::format("{}: {} measurements were refused: {}", score.name, metric.value, what));
  }
}

void AddRejections(const EstimatorScore& score, std::vector<std::string>& remarks) {
  for (const auto& metric : score.metrics.list()) {
    const std::string sensor(Between(metric.name, "rejected_", "_count"));
    if (sensor.empty() || !(metric.value > 0.0)) continue;
    double all = metric.value;
    for (const char* other : {"accepted", "warned", "inflated", "widened"}) {
      all += Count(score.metrics, fmt::format("{}_{}_count", other, sensor));
    }
    if (metric.value < kRejectedShare * all) continue;
    remarks.push_back(fmt::format("{}: its gate rejected {:.1f} % of the corrections by {}",
                                  score.name, 100.0 * metric.value / all, sensor));
  }
}

void AddWidenings(const EstimatorScore& score, std::vector<std::string>& remarks) {
  for (const auto& metric : score.metrics.list()) {
    const std::string_view sensor = Between(metric.name, "widened_", "_count");
    if (sensor.empty() || !(metric.value > 0.0)) continue;
    remarks.push_back(fmt::format(
        "{}: most corrections were rejected, the last by {}: its belief was widened, {} in all",
        score.name, sensor, metric.value));
  }
}

}  // namespace

std::vector<std::string> Remarks(const RunResult& result) {
  std::vector<std::string> remarks;
  for (const EstimatorScore& score : result.scores) {
    const bool started = Count(score.metrics, "estimate_count") > 0.0;
    if (!started) remarks.push_back(fmt::format("{}: it never gave an estimate", score.name));
    const double indefinite = Count(score.metrics, "indefinite_covariance_count");
    if (indefinite > 0.0) {
      remarks.push_back(fmt::format("{}: {} of its covariances are not positive definite",
                                    score.name, indefinite));
    }
    const double unpaired = Count(score.metrics, "unpaired_estimate_count");
    if (unpaired > 0.0) {
      remarks.push_back(
          fmt::format("{}: {} estimates have no truth at their stamps; no score is whole",
                      score.name, unpaired));
    }
    AddRefusals(score, started, remarks);
    AddRejections(score, remarks);
    AddWidenings(score, remarks);
  }
  return remarks;
}

}  // namespace reckon::harness
