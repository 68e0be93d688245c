#include "reckon/harness/schema.h"

#include <algorithm>
#include <charconv>

#include "reckon/harness/describe_scenario.h"
#include "reckon/harness/schema_builder.h"

namespace reckon::harness {

Json ToJson(const YamlNode& node) {
  switch (node.type) {
    case YamlNode::Type::kNull:
      return nullptr;
    case YamlNode::Type::kList: {
      Json list = Json::array();
      for (const YamlNode& item : node.items) list.push_back(ToJson(item));
      return list;
    }
    case YamlNode::Type::kMap: {
      Json map = Json::object();
      for (std::size_t i = 0; i < node.keys.size(); ++i) {
        map[node.keys[i].name] = ToJson(node.items[i]);
      }
      return map;
    }
    case YamlNode::Type::kScalar:
      break;
  }
  if (KindOf(node) == ScalarKind::kBool) return node.text == "true";
  if (KindOf(node) != ScalarKind::kNumber) return node.text;
  const Json number = Json::parse(node.text, nullptr, false);
  return number.is_discarded() ? Json(node.text) : number;
}

Json SchemaOfNumber(const char* type, const Limits& limits) {
  // Whole numbers are written without a point, as people write them.
  const auto number = [](double value) {
    return std::abs(value) < 1e15 && value == std::trunc(value)
               ? Json(static_cast<std::int64_t>(value))
               : Json(value);
  };
  Json schema = {{"type", type}};
  if (std::isfinite(limits.min)) {
    schema[limits.above_min ? "exclusiveMinimum" : "minimum"] = number(limits.min);
  }
  if (std::isfinite(limits.max)) schema["maximum"] = number(limits.max);
  return schema;
}

void SchemaBuilder::Put(const char* key, Json schema, const char* doc, Need need) {
  schema["description"] = doc;
  properties_[key] = std::move(schema);
  if (need == Need::kHere) required_.push_back(key);
}

Json SchemaBuilder::SchemaOfMap(Json entry) {
  return {{"type", "object"},
          {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_-]*$"}, {"maxLength", 64}}},
          {"additionalProperties", std::move(entry)}};
}

Json SchemaBuilder::Take() {
  schema_["properties"] = std::move(properties_);
  if (!required_.empty()) schema_["required"] = std::move(required_);
  schema_["additionalProperties"] = std::move(rest_);
  return std::move(schema_);
}

std::string JsonSchema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "A scenario of reckon"}};
  schema.update(SchemaBuilder::SchemaOfStruct<Scenario>());
  return schema.dump(2) + "\n";
}

}  // namespace reckon::harness
