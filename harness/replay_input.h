#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// What `reckon replay` is asked to go through, by what lies at `path`:
///     a folder with a log.yaml         its sensors, with one invariant EKF: `logs/<folder>`
///     a result folder                  its scenario, over its recording: `replay/<scenario>`
///     a scenario with a `log:`         that scenario, under its own name
/// Overrides hold as in `reckon run`. Throws LogMissing and InputError.
Scenario ReadReplay(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// The name of its results.
std::string ReplayName(const std::filesystem::path& path);

}  // namespace reckon::harness
