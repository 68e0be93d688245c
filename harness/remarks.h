#pragma once

#include <string>
#include <vector>

#include "reckon/harness/run.h"

namespace reckon::harness {

/// What a reader of the scores must know before believing them, one sentence each: an estimator
/// that never started, measurements refused, a gate that rejects more than it should, a covariance
/// that is none.
std::vector<std::string> Remarks(const RunResult& result);

}  // namespace reckon::harness
