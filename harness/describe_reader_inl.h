#pragma once

// The templates of describe_reader.h.

#include "reckon/harness/describe_reader.h"
#include "reckon/harness/nearest.h"

namespace reckon::harness {

template <class T>
bool MapReader::ReadWord(const YamlNode& node, const std::string& path,
                         std::span<const Choice<T>> choices, T& value) {
  std::vector<std::string> names;
  for (const auto& choice : choices) {
    names.push_back(choice.name);
    if (!node.is_scalar() || node.text != choice.name) continue;
    value = choice.value;
    return true;
  }
  const std::string guess = node.is_scalar() ? DidYouMean(node.text, names) : std::string();
  problems_.Add(
      node.at, "'" + path + "': expected " + JoinNames(choices) + ", found " + Found(node) + guess);
  return false;
}

template <class T>
void MapReader::ReadEntry(const YamlNode::Key& key, const YamlNode& node, const std::string& path,
                          const T& prototype, std::map<std::string, T>& map) {
  if (!CheckName(key, path)) return;
  T value = prototype;
  Read(node, path + "/" + key.name, {}, value);
  map.insert_or_assign(key.name, std::move(value));
}

template <class T>
void MapReader::ReadMap(const YamlNode& node, const std::string& path, const T& prototype,
                        bool removable, std::map<std::string, T>& map) {
  if (!node.is_map()) return Expected(node, path, "a map", problems_);
  map.clear();
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const YamlNode& item = node.items[i];
    const bool off = item.type == YamlNode::Type::kNull ||
                     (item.is_scalar() && (item.text == "off" || item.text == "false"));
    if (removable && off) continue;
    ReadEntry(node.keys[i], item, path, prototype, map);
  }
}

template <class T>
void MapReader::ReadList(const YamlNode& node, const std::string& path, Limits limits, T& value) {
  constexpr std::size_t kSize = ListTraits<T>::kSize;
  const std::string what =
      kSize > 0 ? "a list of " + std::to_string(kSize) + " values" : std::string("a list");
  if (!node.is_list() || (kSize > 0 && node.items.size() != kSize)) {
    const std::string found = node.is_list() ? std::to_string(node.items.size()) : Found(node);
    return problems_.Add(node.at, "'" + path + "': expected " + what + ", found " + found);
  }
  if constexpr (kSize == 0) {
    value.clear();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      typename ListTraits<T>::Element element{};
      Read(node.items[i], path + "/" + std::to_string(i), limits, element);
      value.push_back(std::move(element));
    }
  } else {
    for (std::size_t i = 0; i < kSize; ++i) {
      Read(node.items[i], path + "/" + std::to_string(i), limits, value[i]);
    }
  }
}

template <class T>
void MapReader::ReadStruct(const YamlNode& node, const std::string& path, T& value) {
  if (!node.is_map()) return Expected(node, path, "a map", problems_);
  MapReader sub(node, path, problems_);
  Describe(sub, value);
  sub.Finish(KindsOfKeys<T>());
}

template <class T>
void MapReader::Read(const YamlNode& node, const std::string& path, Limits limits, T& value) {
  if constexpr (IsFlag<T>) {
    value = ReadFlag(node, path, problems_).value_or(value);
  } else if constexpr (std::is_same_v<T, double>) {
    value = ReadNumber(node, path, limits, problems_).value_or(value);
  } else if constexpr (IsNumber<T>) {
    // A type smaller than 64 bits has its limits written where it is described.
    if (const auto whole = ReadWhole(node, path, limits, problems_)) value = static_cast<T>(*whole);
  } else if constexpr (IsWord<T>) {
    ReadWord(node, path, Choices<T>(), value);
  } else if constexpr (IsText<T>) {
    value = ReadText(node, path, problems_).value_or(value);
  } else if constexpr (IsTextForm<T>) {
    const auto text = ReadText(node, path, problems_);
    try {
      if (text) value = TextForm<T>::Read(*text);
    } catch (const std::invalid_argument& error) {
      Expected(node, path, error.what(), problems_);
    }
  } else if constexpr (IsOptional<T>) {
    typename T::value_type inner{};
    Read(node, path, limits, inner);
    value = std::move(inner);
  } else if constexpr (IsList<T>) {
    ReadList(node, path, limits, value);
  } else if constexpr (IsMap<T>) {
    ReadMap(node, path, typename T::mapped_type{}, false, value);
  } else {
    ReadStruct(node, path, value);
  }
}

}  // namespace reckon::harness
