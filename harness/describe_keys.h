#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

/// The archive that only collects keys, with the kind forced to one of its choices.
class KeyCollector {
 public:
  static constexpr bool kWrites = false;
  static constexpr bool kListsAll = true;

  explicit KeyCollector(std::size_t forced) : forced_(forced) {}

  template <class T>
  void Field(const char* key, T& /*value*/, const char* /*doc*/, Limits /*limits*/ = {},
             Need /*need*/ = Need::kOptional) {
    keys.emplace_back(key);
  }
  template <class T>
  void Kind(const char* key, T& value, std::span<const Choice<T>> choices, const char* /*doc*/,
            Need /*need*/ = Need::kOptional) {
    keys.emplace_back(key);
    kind_key = key;
    kinds.clear();
    for (const auto& choice : choices) kinds.push_back(choice.name);
    if (forced_ < choices.size()) value = choices[forced_].value;
  }
  void Word(const char* key, std::string& /*value*/,
            const std::vector<Choice<std::string>>& /*choices*/, const char* /*doc*/) {
    keys.emplace_back(key);
  }
  template <class Function>
  void Group(const char* key, const char* /*doc*/, Function /*function*/) {
    keys.emplace_back(key);
  }
  template <class W, class T>
  void WordOr(const char* key, W& /*word*/, std::span<const Choice<W>> /*choices*/, W /*given*/,
              T& /*value*/, const char* /*doc*/) {
    keys.emplace_back(key);
  }
  template <class T>
  void Map(const char* key, std::map<std::string, T>& /*map*/, const T& /*prototype*/,
           const char* /*doc*/) {
    keys.emplace_back(key);
  }
  template <class T>
  void Removable(const char* key, std::map<std::string, T>& /*map*/, const char* /*doc*/) {
    keys.emplace_back(key);
  }
  template <class T>
  void Rest(std::map<std::string, T>& /*map*/, const char* /*doc*/) {}
  void Directive(const char* key, const char* /*doc*/) { keys.emplace_back(key); }

  std::vector<std::string> keys;
  std::optional<std::string> kind_key;
  std::vector<std::string> kinds;  ///< the names of the kinds, if there are any

 private:
  std::size_t forced_;
};

/// For each key of T, the kinds that have it, joined; empty if T has no kinds.
template <class T>
std::map<std::string, std::string> KindsOfKeys() {
  std::map<std::string, std::string> kinds_of;
  for (std::size_t i = 0, n = 1; i < n; ++i) {
    T value{};
    KeyCollector collector(i);
    Describe(collector, value);
    n = collector.kinds.size();
    if (n == 0) return {};
    for (const std::string& key : collector.keys) {
      std::string& kinds = kinds_of[key];
      kinds += (kinds.empty() ? "'" : ", '") + collector.kinds[i] + "'";
    }
  }
  return kinds_of;
}

}  // namespace reckon::harness
