#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reckon/harness/run.h"

namespace reckon::harness {

/// metrics.json: every score of every estimator. The same run gives the same bytes.
nlohmann::ordered_json MetricsJson(const RunResult& result);

/// run.json: where, when and how fast it ran, what it cost, how it ended and how to repeat it.
nlohmann::ordered_json RunJson(const RunResult& result, const std::string& command);

/// run.json of a run that was scored again: its expectations and exit code are those of `result`.
nlohmann::ordered_json WithVerdicts(nlohmann::ordered_json run, const RunResult& result);

/// The finished run that its run.json and metrics.json tell of: verdicts and scores; nothing if it
/// did not finish, it was scored otherwise since, or the texts are no such files. `catalogue` holds
/// the metrics to look for.
std::optional<RunResult> ReadRunJson(const std::string& run_text, const std::string& metrics_text,
                                     const ground_truth::Metrics& catalogue);

/// What `--json` prints for one run: outcome, expectations and scores.
nlohmann::ordered_json SummaryJson(const RunResult& result, const std::string& command);

}  // namespace reckon::harness
