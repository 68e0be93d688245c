#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reckon/harness/yaml_error.h"

namespace reckon::harness {

/// A YAML value that knows where it was written. A map keeps the order of its keys; `keys` and
/// `items` then go together.
struct YamlNode {
  enum class Type { kNull, kScalar, kList, kMap };
  struct Key {
    std::string name;
    Location at;
  };

  Type type = Type::kNull;
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< a quoted scalar is text, whatever it looks like
  Location at;
  int layer = 0;  ///< where it came from: defaults are below includes, scenario, overrides
  std::vector<Key> keys;
  std::vector<YamlNode> items;

  bool is_map() const { return type == Type::kMap; }
  bool is_list() const { return type == Type::kList; }
  bool is_scalar() const { return type == Type::kScalar; }

  /// The value of a key; null if there is none.
  const YamlNode* Find(std::string_view key) const;
  YamlNode* Find(std::string_view key);
  /// The value at a path of keys and list indices such as `/faults/0/kind`; null if there is none.
  const YamlNode* At(std::string_view path) const;
  /// Adds a key to a map that does not have it yet.
  YamlNode& Add(std::string key, YamlNode value);
  void Erase(std::string_view key);
  /// The highest layer in this value.
  int TopLayer() const;
};

/// How an unquoted scalar reads by YAML 1.2's core rules.
enum class ScalarKind { kNull, kBool, kNumber, kText };
ScalarKind KindOf(const YamlNode& scalar);

/// `text` as a message can show it: on one line and not too long.
std::string Shown(std::string_view text);

/// `a list`, `a map`, `nothing`, or the scalar itself in quotes: for messages.
std::string Found(const YamlNode& node);

}  // namespace reckon::harness
