#pragma once

#include <map>
#include <string>
#include <utility>

#include "reckon/harness/describe_traits.h"
#include "reckon/harness/yaml_emit.h"
#include "reckon/harness/yaml_values.h"

namespace reckon::harness {

/// The archive that turns a struct into a YAML tree, every value written out, in the order of its
/// description.
class MapWriter {
 public:
  static constexpr bool kWrites = true;
  static constexpr bool kListsAll = false;

  MapWriter() { node_.type = YamlNode::Type::kMap; }

  template <class T>
  void Field(const char* key, T& value, const char* /*doc*/, Limits /*limits*/ = {},
             Need /*need*/ = Need::kOptional) {
    if constexpr (IsOptional<T>) {
      if (value) node_.Add(key, Write(*value));  // what is absent has no default to write
    } else {
      node_.Add(key, Write(value));
    }
  }

  template <class T>
  void Kind(const char* key, T& value, std::span<const Choice<T>> choices, const char* /*doc*/,
            Need /*need*/ = Need::kOptional) {
    node_.Add(key, WriteWord(value, choices));
  }

  void Word(const char* key, std::string& value,
            const std::vector<Choice<std::string>>& /*choices*/, const char* /*doc*/) {
    node_.Add(key, TextNode(value));
  }

  template <class Function>
  void Group(const char* key, const char* /*doc*/, Function function) {
    MapWriter sub;
    function(sub);
    node_.Add(key, std::move(sub.node_));
  }

  template <class W, class T>
  void WordOr(const char* key, W& /*word*/, std::span<const Choice<W>> /*choices*/, W /*given*/,
              T& value, const char* /*doc*/) {
    node_.Add(key, Write(value));  // the numbers, whatever their source
  }

  template <class T>
  void Map(const char* key, std::map<std::string, T>& map, const T& /*prototype*/,
           const char* /*doc*/) {
    node_.Add(key, Write(map));
  }

  template <class T>
  void Removable(const char* key, std::map<std::string, T>& map, const char* /*doc*/) {
    node_.Add(key, Write(map));
  }

  template <class T>
  void Rest(std::map<std::string, T>& map, const char* /*doc*/) {
    for (auto& [key, value] : map) node_.Add(key, Write(value));
  }

  void Directive(const char* /*key*/, const char* /*doc*/) {}

  template <class T>
  static YamlNode Write(T& value);

  YamlNode& node() { return node_; }

 private:
  template <class T>
  static YamlNode WriteWord(const T& value, std::span<const Choice<T>> choices) {
    for (const auto& choice : choices) {
      if (choice.value == value) return TextNode(choice.name);
    }
    return {};
  }

  YamlNode node_;
};

template <class T>
YamlNode MapWriter::Write(T& value) {
  if constexpr (IsFlag<T>) {
    return PlainNode(value ? "true" : "false");
  } else if constexpr (std::is_same_v<T, double>) {
    return PlainNode(NumberText(value));
  } else if constexpr (IsNumber<T>) {
    return PlainNode(std::to_string(value));
  } else if constexpr (IsWord<T>) {
    return WriteWord(value, Choices<T>());
  } else if constexpr (IsText<T>) {
    return TextNode(value);
  } else if constexpr (IsTextForm<T>) {
    return TextNode(TextForm<T>::Write(value));
  } else if constexpr (IsList<T>) {
    YamlNode list;
    list.type = YamlNode::Type::kList;
    for (auto& item : value) list.items.push_back(Write(item));
    return list;
  } else if constexpr (IsMap<T>) {
    YamlNode map;
    map.type = YamlNode::Type::kMap;
    for (auto& [key, item] : value) map.Add(key, Write(item));
    return map;
  } else {
    MapWriter sub;
    Describe(sub, value);
    return std::move(sub.node());
  }
}

}  // namespace reckon::harness
