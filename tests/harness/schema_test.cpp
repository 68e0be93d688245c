#include "reckon/harness/schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "reckon/harness/schema_builder.h"
#include "reckon/harness/yaml_load.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

/// The part of JSON Schema that ours uses; any other keyword is refused, so that none is ignored.
bool IsValid(const Json& schema, const Json& value);

bool HasType(const std::string& type, const Json& value) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  throw std::logic_error("type " + type);
}

bool IsValidObject(const Json& schema, const Json& value) {
  for (const auto& key : schema.value("required", Json::array())) {
    if (!value.contains(key.get<std::string>())) return false;
  }
  const Json properties = schema.value("properties", Json::object());
  for (const auto& [key, item] : value.items()) {
    if (schema.contains("propertyNames") && !IsValid(schema["propertyNames"], key)) return false;
    const Json& rule = properties.contains(key) ? properties[key] : schema["additionalProperties"];
    if (rule.is_boolean() ? !rule.get<bool>() : !IsValid(rule, item)) return false;
  }
  return true;
}

bool IsValidArray(const Json& schema, const Json& value) {
  if (value.size() < schema.value("minItems", std::size_t{0})) return false;
  if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return false;
  return std::all_of(value.begin(), value.end(),
                     [&](const Json& item) { return IsValid(schema["items"], item); });
}

bool HoldsKeyword(const std::string& word, const Json& rule, const Json& value) {
  if (word == "type") return HasType(rule, value);
  if (word == "const") return value == rule;
  if (word == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
  if (word == "anyOf") {
    return std::any_of(rule.begin(), rule.end(),
                       [&](const Json& schema) { return IsValid(schema, value); });
  }
  if (word == "pattern") {
    return !value.is_string() ||
           std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
  }
  if (word == "maxLength") return !value.is_string() || value.get<std::string>().size() <= rule;
  if (word == "minimum") return !value.is_number() || value >= rule;
  if (word == "exclusiveMinimum") return !value.is_number() || value > rule;
  if (word == "maximum") return !value.is_number() || value <= rule;
  for (const char* other :
       {"properties", "required", "additionalProperties", "propertyNames", "items", "minItems",
        "maxItems", "title", "description", "default", "$schema"}) {
    if (word == other) return true;
  }
  throw std::logic_error("keyword " + word);
}

bool IsValid(const Json& schema, const Json& value) {
  for (const auto& [word, rule] : schema.items()) {
    if (!HoldsKeyword(word, rule, value)) return false;
  }
  if (value.is_object() && schema.contains("properties")) return IsValidObject(schema, value);
  if (value.is_object() && schema.contains("additionalProperties")) {
    return IsValidObject(schema, value);
  }
  return !value.is_array() || !schema.contains("items") || IsValidArray(schema, value);
}

bool SchemaTakes(const std::string& text) {
  static const Json schema = Json::parse(JsonSchema());
  return IsValid(schema, ToJson(ParseYaml(text, "sc.yaml")));
}

bool ReaderTakes(const std::string& text) {
  try {
    ReadScenarioText(text, "sc.yaml");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(Schema, PublishedFileIsTheProgramsOwn) {
  // If this fails: build/release/reckon check --schema > scenarios/scenario.schema.json
  std::ifstream file(RECKON_SOURCE_DIR "/scenarios/scenario.schema.json");
  const std::string published{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(published == JsonSchema()) << "scenarios/scenario.schema.json is out of date";
}

/// Calls `visit` with every schema of an object inside `schema`.
template <class Function>
void ForEachProperty(const Json& schema, const Function& visit) {
  if (schema.is_object() && schema.contains("properties") && schema["properties"].is_object()) {
    for (const auto& [key, property] : schema["properties"].items()) visit(key, property);
  }
  for (const auto& [word, inner] : schema.items()) {
    if (inner.is_structured()) ForEachProperty(inner, visit);
  }
}

TEST(Schema, ExplainsEveryKeyAndItsDefaultsAreValid) {
  int properties = 0, defaults = 0;
  ForEachProperty(Json::parse(JsonSchema()), [&](const std::string& key, const Json& property) {
    ++properties;
    EXPECT_FALSE(property.value("description", "").empty()) << key;
    if (!property.contains("default")) return;
    ++defaults;
    EXPECT_TRUE(IsValid(property, property["default"])) << key << ": " << property["default"];
  });
  EXPECT_GT(properties, 200);
  EXPECT_GT(defaults, 150);
}

TEST(Schema, TakesWhatTheReaderTakes) {
  for (const char* text : {
           "seed: 1\n",
           "robot: husky\nworld: {terrain: {kind: rough, rms_m: 0.1}}\n",
           "world: {patches: [{box_m: [0, 0, 1, 1]}]}\n",
           "sensors: {imu: {rate_hz: 100}}\n",
           "sensors: {imu: {type: imu, gyro: {scale: 0.1}}}\n",
           "sensors: {wheels: off}\n",
           "sensors: {v: {type: body_velocity, frame: velocity_link, noise_m_per_s: [1, 2, 3]}}\n",
           "faults: [{sensor: imu, kind: bias_step, at_s: 1, offset: -2}]\n",
           "sensors: {p: {type: pose, frame: base_link, orientation: false}}\n",
           "sensors: {d: {type: depth, frame: base_link, resolution_m: 0.01}}\n"
           "estimators: {a: {noise: {depth_m: 0.1}}}\n",
           "estimators: {a: {type: iterated_inekf, iterations: 20, history_s: 0}}\n",
           "estimators: {a: {standstill: {use: false}, floor: {height_m: -1}}}\n",
           "estimators: {a: {}, b: {type: mekf, noise: matched}}\n",
           "estimators: {a: {type: process, command: [cat]}}\n",
           "estimators: {a: {initialisation: {kind: static, static_duration_s: 2}}}\n",
           "estimators: {a: {}}\nexpect: {a: {ate_position_rmse_m: {max: 1}}}\n",
           "estimators: {a: {}}\nexpect: {a: {consistency: {false_alarm: 1.0e-6}}}\n",
           "estimators: {a: {}}\n"
           "expect: {compare: [a.ate_position_rmse_m < 2 * a.ate_position_rmse_m]}\n",
           "motion: {path: waypoints, waypoints_m: [[1, 2], [3, 4]]}\n",
           "expect: {exit_code: 3}\n",
       }) {
    EXPECT_TRUE(ReaderTakes(text)) << text;
    EXPECT_TRUE(SchemaTakes(text)) << text;
  }
}

TEST(Schema, RefusesWhatTheReaderRefuses) {
  for (const char* text : {
           "sede: 1\n",
           "seed: -1\n",
           "seed: 1.5\n",
           "seed: one\n",
           "robot: 7\n",
           "schema: 2\n",
           "duration_s: 0\n",
           "duration_s: .nan\n",
           "world: []\n",
           "world: {terrain: {kind: hilly}}\n",
           "world: {terrain: {kind: flat, rms_m: 0.1}}\n",
           "world: {physics_step_s: 1}\n",
           "world: {patches: [{friction: 1}]}\n",
           "actual: {wheel_radius_scale: [1]}\n",
           "actual: {com_offset_m: [0, 0, 0, 0]}\n",
           "sensors: {imu: {grade: best}}\n",
           "sensors: {imu: on}\n",
           "sensors: {'2': {type: imu, frame: imu_link}}\n",
           "faults: [{sensor: imu, kind: dropout}]\n",
           "faults: [{sensor: imu, kind: dropout, at_s: 1, offset: 1}]\n",
           "estimators: {a: {type: ekf}}\n",
           "estimators: {a: {type: inekf, iterations: 3}}\n",
           "estimators: {a: {type: iterated_inekf, iterations: 0}}\n",
           "estimators: {a: {type: odometry, floor: {use: false}}}\n",
           "estimators: {a: {history_s: 11}}\n",
           "sensors: {feet: {type: toes, frame: base_link}}\n",
           "sensors: {p: {type: pose, frame: base_link, noise_position_m: 1}}\n",
           "estimators: {a: {noise: loud}}\n",
           "estimators: {a: {type: mekf, command: [cat]}}\n",
           "score: {align: best}\n",
           "score: {rpe_m: [0]}\n",
           "record: {truth: 1}\n",
           "expect: {compare: [a is better]}\n",
           "expect: {inekf: {ate_position_rmse_m: {below: 1}}}\n",
           "expect: {exit_code: 4}\n",
           "video: {}\n",
       }) {
    EXPECT_FALSE(ReaderTakes(text)) << text;
    EXPECT_FALSE(SchemaTakes(text)) << text;
  }
}

}  // namespace
}  // namespace reckon::harness
