#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/harness/scenario.h"
#include "reckon/harness/scenario_paths.h"
#include "reckon/harness/yaml_error.h"

namespace reckon::harness {

/// Reads a scenario and everything that it stands on, and checks it whole. Later ones win: struct
/// defaults, the robot's own suite (unless `robot_defaults: false`), the files of `include:`, the
/// file, `overrides` (each `a.b=c`) in their order. Throws InputError.
Scenario ReadScenario(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same for a text; `name` stands in messages, and includes are relative to its folder.
Scenario ReadScenarioText(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides = {});

/// Checks a scenario without running it and returns it with every default written out.
std::string CheckText(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace reckon::harness
