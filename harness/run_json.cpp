#include "reckon/harness/run_json.h"

#include <sys/utsname.h>

#include <limits>
#include <string_view>
#include <utility>

#include "reckon/build_info.h"
#include "reckon/sim/world.h"

namespace reckon::harness {
namespace {

using nlohmann::ordered_json;

std::string_view OutcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFinished:
      return "finished";
    case Outcome::kFailed:
      return "failed";
    case Outcome::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

ordered_json PlatformJson() {
  utsname name{};
  uname(&name);
  return {{"system", name.sysname},
          {"release", name.release},
          {"machine", name.machine},
          {"compiler", __VERSION__},
          {"physics", sim::World::PhysicsVersion()}};
}

ordered_json CallJson(const CallCost& cost) {
  return {{"calls", cost.calls}, {"mean_us", cost.mean_us()}};
}

ordered_json CostsJson(const Costs& costs) {
  ordered_json estimators = ordered_json::object();
  for (const auto& [name, cost] : costs.estimators) {
    estimators[name] = {{"propagation", CallJson(cost.propagations)},
                        {"correction", CallJson(cost.corrections)}};
  }
  return {{"setup_s", costs.setup_s},         {"physics_and_driver_s", costs.physics_s},
          {"sensors_s", costs.sensors_s},     {"estimators_s", costs.estimators_s},
          {"recording_s", costs.recording_s}, {"scoring_s", costs.scoring_s},
          {"estimators", estimators}};
}

ordered_json VerdictsJson(const RunResult& result) {
  ordered_json verdicts = ordered_json::array();
  for (const Verdict& verdict : result.verdicts) {
    verdicts.push_back({{"expectation", verdict.expectation},
                        {"holds", verdict.holds},
                        {"detail", verdict.detail}});
  }
  return verdicts;
}

ordered_json EstimatorsJson(const RunResult& result) {
  ordered_json estimators = ordered_json::object();
  for (const EstimatorScore& score : result.scores) {
    estimators[score.name] = ToJson(score.metrics);
  }
  return estimators;
}

/// The metrics of `catalogue` with the values that ToJson wrote.
ground_truth::Metrics ReadMetrics(const ordered_json& scores,
                                  const ground_truth::Metrics& catalogue) {
  ground_truth::Metrics metrics;
  const bool valid = scores.at("valid");
  for (ground_truth::Metric metric : catalogue.list()) {
    const ordered_json& value = scores.at(metric.name);
    metric.value = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    metric.applies = !value.is_null() || !valid;
    metrics.Add(std::move(metric));
  }
  return metrics;
}

}  // namespace

ordered_json MetricsJson(const RunResult& result) {
  ordered_json json = {
      {"schema", 1}, {"seed", result.seed}, {"complete", result.outcome == Outcome::kFinished}};
  if (!result.score_overrides.empty()) json["score_overrides"] = result.score_overrides;
  json["estimators"] = EstimatorsJson(result);
  return json;
}

ordered_json RunJson(const RunResult& result, const std::string& command) {
  ordered_json json = {{"schema", 1},
                       {"scenario", result.scenario},
                       {"seed", result.seed},
                       {"outcome", OutcomeName(result.outcome)},
                       {"failure", result.failure},
                       {"exit_code", result.exit_code()},
                       {"command", command},
                       {"version", RECKON_VERSION},
                       {"commit", RECKON_COMMIT},
                       {"platform", PlatformJson()},
                       {"simulated_s", result.costs.simulated_s},
                       {"wall_s", result.costs.wall_s},
                       {"real_time_factor", result.costs.real_time_factor()},
                       {"costs", CostsJson(result.costs)},
                       {"expectations", VerdictsJson(result)}};
  return json;
}

ordered_json WithVerdicts(ordered_json run, const RunResult& result) {
  run["exit_code"] = result.exit_code();
  run["expectations"] = VerdictsJson(result);
  return run;
}

std::optional<RunResult> ReadRunJson(const std::string& run_text, const std::string& metrics_text,
                                     const ground_truth::Metrics& catalogue) try {
  const auto run = ordered_json::parse(run_text);
  const auto metrics = ordered_json::parse(metrics_text);
  if (run.at("outcome") != OutcomeName(Outcome::kFinished)) return std::nullopt;
  if (metrics.contains("score_overrides")) return std::nullopt;  // not that run's own scores
  RunResult result;
  for (const auto& verdict : run.at("expectations")) {
    result.verdicts.push_back(
        {verdict.at("expectation"), verdict.at("holds"), verdict.at("detail")});
  }
  for (const auto& [name, scores] : metrics.at("estimators").items()) {
    result.scores.push_back({name, ReadMetrics(scores, catalogue)});
  }
  return result;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

ordered_json SummaryJson(const RunResult& result, const std::string& command) {
  return {{"scenario", result.scenario},
          {"seed", result.seed},
          {"results", result.folder.string()},
          {"outcome", OutcomeName(result.outcome)},
          {"failure", result.failure},
          {"exit_code", result.exit_code()},
          {"command", command},
          {"expectations", VerdictsJson(result)},
          {"estimators", EstimatorsJson(result)}};
}

}  // namespace reckon::harness
