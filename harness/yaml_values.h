#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reckon/harness/describe.h"
#include "reckon/harness/yaml_node.h"

namespace reckon::harness {

/// ` from 0 to 1`, ` above 0`, … or nothing.
std::string LimitsText(const Limits& limits);

/// Whether `value` is finite and inside `limits`.
bool Holds(const Limits& limits, double value);

/// One finite number inside `limits`; otherwise a problem is noted and nothing is returned.
std::optional<double> ReadNumber(const YamlNode& node, const std::string& path,
                                 const Limits& limits, Problems& problems);
std::optional<std::uint64_t> ReadWhole(const YamlNode& node, const std::string& path,
                                       const Limits& limits, Problems& problems);
std::optional<bool> ReadFlag(const YamlNode& node, const std::string& path, Problems& problems);
std::optional<std::string> ReadText(const YamlNode& node, const std::string& path,
                                    Problems& problems);

/// Notes `'<path>': expected <what>, found …`.
void Expected(const YamlNode& node, const std::string& path, const std::string& what,
              Problems& problems);

/// Whether `name` can name a sensor or an estimator: letters, digits, `_` and `-`, not a digit
/// first.
bool IsName(const std::string& name);

/// The shortest text that reads back as exactly this number.
std::string NumberText(double value);

}  // namespace reckon::harness
