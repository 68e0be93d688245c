#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reckon/harness/yaml_node.h"

namespace reckon::harness {

/// Reads one YAML document. Refused, by InputError with `source` and the place: ill-formed text, a
/// key written twice, several documents, an empty one, text that is not UTF-8, more than 100,000
/// values or 64 levels (which anchors can reach with few bytes).
YamlNode ParseYaml(const std::string& text, const std::string& source, int layer = 0);

/// The same, and refuses a document that is no map.
YamlNode ParseYamlFile(const std::string& text, const std::string& source);

/// The same for a file of at most 1 MB; refuses one that can't be read.
YamlNode LoadYamlFile(const std::filesystem::path& path);

/// Lays `over` onto `base`: maps key by key, everything else as a whole.
void Merge(const YamlNode& over, YamlNode& base);

/// Applies `--set a.b=c`; a number in the path is a list's index. The value is YAML. Its layer
/// should lie above all others. Refuses, by InputError, a text without `=` and an index beyond a
/// list.
void ApplyOverride(const std::string& text, int layer, YamlNode& root);

}  // namespace reckon::harness
