#pragma once

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reckon/harness/describe_keys.h"
#include "reckon/harness/yaml_values.h"

namespace reckon::harness {

/// The archive that reads one YAML map into a struct that holds its defaults. What is wrong goes to
/// `problems`; the member then keeps its default, so that reading goes on.
class MapReader {
 public:
  static constexpr bool kWrites = false;
  static constexpr bool kListsAll = false;

  MapReader(const YamlNode& node, std::string path, Problems& problems)
      : node_(node), path_(std::move(path)), problems_(problems) {}

  template <class T>
  void Field(const char* key, T& value, const char* /*doc*/, Limits limits = {},
             Need need = Need::kOptional) {
    if (const YamlNode* node = Take(key, need)) Read(*node, PathOf(key), limits, value);
  }

  template <class T>
  void Kind(const char* key, T& value, std::span<const Choice<T>> choices, const char* /*doc*/,
            Need need = Need::kOptional) {
    kind_key_ = key;
    const YamlNode* node = Take(key, need);
    if (node != nullptr && !ReadWord(*node, PathOf(key), choices, value)) kind_is_known_ = false;
    for (const auto& choice : choices) {
      if (choice.value == value) kind_name_ = choice.name;
    }
  }

  void Word(const char* key, std::string& value, const std::vector<Choice<std::string>>& choices,
            const char* /*doc*/) {
    const YamlNode* node = Take(key, Need::kOptional);
    if (node != nullptr) ReadWord(*node, PathOf(key), std::span(choices), value);
  }

  template <class Function>
  void Group(const char* key, const char* /*doc*/, Function function) {
    const YamlNode* node = Take(key, Need::kOptional);
    if (node == nullptr) return;
    if (!node->is_map()) return Expected(*node, PathOf(key), "a map", problems_);
    MapReader sub(*node, PathOf(key), problems_);
    function(sub);
    sub.Finish({});
  }

  template <class W, class T>
  void WordOr(const char* key, W& word, std::span<const Choice<W>> choices, W given, T& value,
              const char* /*doc*/) {
    const YamlNode* node = Take(key, Need::kOptional);
    if (node == nullptr) return;
    if (node->is_map()) {
      word = given;
      return Read(*node, PathOf(key), {}, value);
    }
    ReadWord(*node, PathOf(key), choices, word);
  }

  template <class T>
  void Map(const char* key, std::map<std::string, T>& map, const T& prototype,
           const char* /*doc*/) {
    if (const YamlNode* node = Take(key, Need::kOptional)) {
      ReadMap(*node, PathOf(key), prototype, false, map);
    }
  }

  template <class T>
  void Removable(const char* key, std::map<std::string, T>& map, const char* /*doc*/) {
    if (const YamlNode* node = Take(key, Need::kOptional)) {
      ReadMap(*node, PathOf(key), T{}, true, map);
    }
  }

  template <class T>
  void Rest(std::map<std::string, T>& map, const char* /*doc*/) {
    map.clear();
    for (std::size_t i = 0; i < node_.keys.size(); ++i) {
      const std::string& key = node_.keys[i].name;
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      ReadEntry(node_.keys[i], node_.items[i], path_, T{}, map);
    }
    takes_all_ = true;
  }

  void Directive(const char* key, const char* /*doc*/) { known_.emplace_back(key); }

  /// Complains about keys that nothing asked for. `kinds_of_keys` tells which kinds have them.
  void Finish(const std::map<std::string, std::string>& kinds_of_keys) const;

  template <class T>
  void Read(const YamlNode& node, const std::string& path, Limits limits, T& value);

 private:
  /// The value of `key`, or null; notes that the key is known, and complains if it is missed.
  const YamlNode* Take(const char* key, Need need);
  std::string PathOf(const std::string& key) const { return path_ + "/" + key; }
  /// Whether `key` can name an entry of an open map.
  bool CheckName(const YamlNode::Key& key, const std::string& path) const;

  template <class T>
  bool ReadWord(const YamlNode& node, const std::string& path, std::span<const Choice<T>> choices,
                T& value);
  template <class T>
  void ReadMap(const YamlNode& node, const std::string& path, const T& prototype, bool removable,
               std::map<std::string, T>& map);
  template <class T>
  void ReadEntry(const YamlNode::Key& key, const YamlNode& node, const std::string& path,
                 const T& prototype, std::map<std::string, T>& map);
  template <class T>
  void ReadList(const YamlNode& node, const std::string& path, Limits limits, T& value);
  template <class T>
  void ReadStruct(const YamlNode& node, const std::string& path, T& value);

  const YamlNode& node_;
  std::string path_;
  Problems& problems_;
  std::vector<std::string> known_;
  std::string kind_key_, kind_name_;
  bool kind_is_known_ = true;
  bool takes_all_ = false;
};

/// Reads a whole document into `value`.
template <class T>
void ReadDocument(const YamlNode& root, Problems& problems, T& value) {
  MapReader(root, "", problems).Read(root, "", {}, value);
}

}  // namespace reckon::harness

#include "reckon/harness/describe_reader_inl.h"
