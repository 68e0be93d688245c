#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "reckon/harness/describe_writer.h"

namespace reckon::harness {

using Json = nlohmann::ordered_json;

/// A YAML tree as JSON.
Json ToJson(const YamlNode& node);

/// The archive that builds a JSON Schema of one map. The value that it is given holds the defaults.
class SchemaBuilder {
 public:
  static constexpr bool kWrites = false;
  static constexpr bool kListsAll = true;

  explicit SchemaBuilder(std::size_t forced_kind) : forced_kind_(forced_kind) {}

  template <class T>
  void Field(const char* key, T& value, const char* doc, Limits limits = {},
             Need need = Need::kOptional) {
    Json schema = SchemaOf<T>(limits);
    if constexpr (!IsStruct<T> && !IsOptional<T> && !IsMap<T>) {
      if (need == Need::kOptional) schema["default"] = ToJson(MapWriter::Write(value));
    }
    Put(key, std::move(schema), doc, need);
  }

  template <class T>
  void Kind(const char* key, T& value, std::span<const Choice<T>> choices, const char* doc,
            Need need = Need::kOptional) {
    kinds_ = choices.size();
    if (forced_kind_ < choices.size()) value = choices[forced_kind_].value;
    for (const auto& choice : choices) {
      if (choice.value != value) continue;
      schema_["title"] = choice.name;
      schema_["description"] = choice.doc;
      Put(key, {{"const", choice.name}}, doc, need);
    }
  }

  void Word(const char* key, std::string& value, const std::vector<Choice<std::string>>& choices,
            const char* doc) {
    Json schema = SchemaOfWords(std::span(choices));
    schema["default"] = value;
    Put(key, std::move(schema), doc, Need::kOptional);
  }

  template <class Function>
  void Group(const char* key, const char* doc, Function function) {
    SchemaBuilder sub(0);
    function(sub);
    Put(key, sub.Take(), doc, Need::kOptional);
  }

  template <class W, class T>
  void WordOr(const char* key, W& /*word*/, std::span<const Choice<W>> choices, W /*given*/,
              T& /*value*/, const char* doc) {
    Json schema;
    schema["anyOf"] = {SchemaOfWords(choices), SchemaOf<T>({})};
    Put(key, std::move(schema), doc, Need::kOptional);
  }

  template <class T>
  void Map(const char* key, std::map<std::string, T>& /*map*/, const T& /*prototype*/,
           const char* doc) {
    Put(key, SchemaOfMap(SchemaOfStruct<T>()), doc, Need::kOptional);
  }

  template <class T>
  void Removable(const char* key, std::map<std::string, T>& /*map*/, const char* doc) {
    Json entry;
    entry["anyOf"] = {{{"enum", {"off", false, nullptr}}}, SchemaOfStruct<T>()};
    Put(key, SchemaOfMap(std::move(entry)), doc, Need::kOptional);
  }

  template <class T>
  void Rest(std::map<std::string, T>& /*map*/, const char* /*doc*/) {
    rest_ = SchemaOfStruct<T>();
  }

  void Directive(const char* key, const char* doc) {
    const Json text = {{"type", "string"}};
    Json schema;
    schema["anyOf"] = {text, {{"type", "array"}, {"items", text}}};
    Put(key, std::move(schema), doc, Need::kOptional);
  }

  template <class T>
  static Json SchemaOf(Limits limits);
  template <class T>
  static Json SchemaOfStruct();

  /// The schema of the map so far.
  Json Take();
  /// How many kinds the described struct has; 0: none.
  std::size_t kinds() const { return kinds_; }

 private:
  void Put(const char* key, Json schema, const char* doc, Need need);
  static Json SchemaOfMap(Json entry);

  template <class T>
  static Json SchemaOfWords(std::span<const Choice<T>> choices) {
    Json schema;
    for (const auto& choice : choices) schema["enum"].push_back(choice.name);
    return schema;
  }

  std::size_t forced_kind_;
  std::size_t kinds_ = 0;
  Json schema_ = {{"type", "object"}};
  Json properties_ = Json::object();
  Json required_ = Json::array();
  Json rest_ = false;
};

/// The schema of a number with limits.
Json SchemaOfNumber(const char* type, const Limits& limits);

template <class T>
Json SchemaBuilder::SchemaOfStruct() {
  Json alternatives = Json::array();
  for (std::size_t i = 0, n = 1; i < n; ++i) {
    T value{};
    SchemaBuilder builder(i);
    Describe(builder, value);
    if (builder.kinds() == 0) return builder.Take();
    n = builder.kinds();
    alternatives.push_back(builder.Take());
  }
  return {{"anyOf", std::move(alternatives)}};
}

template <class T>
Json SchemaBuilder::SchemaOf([[maybe_unused]] Limits limits) {
  if constexpr (IsFlag<T>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_same_v<T, double>) {
    return SchemaOfNumber("number", limits);
  } else if constexpr (IsNumber<T>) {
    limits.min = std::max(limits.min, 0.0);
    return SchemaOfNumber("integer", limits);
  } else if constexpr (IsWord<T>) {
    return SchemaOfWords(Choices<T>());
  } else if constexpr (IsText<T>) {
    return {{"type", "string"}};
  } else if constexpr (IsTextForm<T>) {
    return {{"type", "string"}, {"pattern", TextForm<T>::kPattern}};
  } else if constexpr (IsOptional<T>) {
    return SchemaOf<typename T::value_type>(limits);
  } else if constexpr (IsList<T>) {
    Json schema = {{"type", "array"}, {"items", SchemaOf<typename ListTraits<T>::Element>(limits)}};
    if constexpr (IsFixedList<T>) {
      schema["minItems"] = ListTraits<T>::kSize;
      schema["maxItems"] = ListTraits<T>::kSize;
    }
    return schema;
  } else if constexpr (IsMap<T>) {
    return SchemaOfMap(SchemaOf<typename T::mapped_type>(limits));
  } else {
    return SchemaOfStruct<T>();
  }
}

}  // namespace reckon::harness
