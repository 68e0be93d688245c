#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reckon/harness/nearest.h"
#include "reckon/harness/yaml_node.h"
#include "reckon/harness/yaml_values.h"

namespace reckon::harness {

using Names = std::vector<std::string>;

inline bool Holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What rules about a scenario complain with: each complaint stands where the value was written.
class RuleBook {
 public:
  /// `root` is what the scenario was read from.
  RuleBook(const YamlNode& root, Problems& problems) : root_(root), problems_(problems) {}

  /// Whether there is a value at `path`.
  bool IsWritten(const std::string& path) const { return root_.At(path) != nullptr; }

  void Complain(const std::string& path, const std::string& what) const {
    problems_.Add(Where(path), "'" + path + "': " + what);
  }

  void Require(bool holds, const std::string& path, const std::string& expected) const {
    if (holds) return;
    const YamlNode* node = root_.At(path);
    Complain(path, "expected " + expected + (node != nullptr ? ", found " + Found(*node) : ""));
  }

  void RequireOneOf(const std::string& name, const Names& names, const std::string& path,
                    const std::string& what) const {
    if (Holds(names, name)) return;
    Complain(path, "there is no " + what + " '" + Shown(name) + "'" + DidYouMean(name, names));
  }

 private:
  /// Where the value at `path` was written, or else what holds it.
  Location Where(std::string path) const {
    while (!path.empty()) {
      if (const YamlNode* node = root_.At(path)) return node->at;
      path.resize(path.rfind('/'));
    }
    return root_.at;
  }

  const YamlNode& root_;
  Problems& problems_;
};

}  // namespace reckon::harness
