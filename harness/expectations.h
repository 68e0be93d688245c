#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// One expectation after a run.
struct Verdict {
  std::string expectation;  ///< as a reader would write it: `riekf.ate_position_rmse_m <= 0.3`
  bool holds = false;
  std::string detail;  ///< what was found and by how much it misses; empty if it holds
};

/// What the expectations of a scenario are judged by.
struct Findings {
  /// The value of an estimator's metric; nothing if the metric is missing or not finite.
  std::function<std::optional<double>(const std::string& estimator, const std::string& metric)>
      metric;
  /// The complaints of the consistency test of one estimator at a false-alarm rate; empty: honest.
  std::function<std::vector<std::string>(const std::string& estimator, double false_alarm)>
      inconsistencies;
};

/// Judges every expectation, in the order of the file. A metric that is missing fails.
std::vector<Verdict> Judge(const ExpectConfig& expect, const Findings& findings);

}  // namespace reckon::harness
