#pragma once

#include <string>

#include "reckon/harness/run.h"

namespace reckon::harness {

/// The result of one run as text: a line about the run, a row an estimator, and the expectations
/// that failed with the command that repeats the run. `color` marks the verdicts.
std::string ScoreTable(const RunResult& result, const std::string& command, bool color);

}  // namespace reckon::harness
