#pragma once

#include <string>

#include "reckon/harness/yaml_node.h"

namespace reckon::harness {

/// A scalar that is text (quoted where it would read as something else), or a plain one.
YamlNode TextNode(std::string text);
YamlNode PlainNode(std::string text);

/// Writes a tree as YAML: maps as indented blocks, lists of plain values on one line, other lists
/// one entry a line. The same tree gives the same bytes.
std::string EmitYaml(const YamlNode& root);

}  // namespace reckon::harness
