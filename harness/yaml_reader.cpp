#include "reckon/harness/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "reckon/harness/describe_reader.h"
#include "reckon/harness/describe_scenario.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/scenario_noise.h"
#include "reckon/harness/scenario_rules.h"
#include "reckon/harness/yaml_load.h"
#include "reckon/harness/yaml_writer.h"

namespace reckon::harness {

namespace fs = std::filesystem;

namespace {

void SetLayer(int layer, YamlNode& node) {
  node.layer = layer;
  for (YamlNode& item : node.items) SetLayer(layer, item);
}

/// The values of `include:`; none if the key is absent.
std::vector<YamlNode> IncludesOf(const YamlNode& root) {
  const YamlNode* include = root.Find("include");
  if (include == nullptr) return {};
  std::vector<YamlNode> files = include->is_list() ? include->items : std::vector{*include};
  for (const YamlNode& file : files) {
    if (!file.is_scalar() || file.text.empty()) {
      Fail(file.at, "'/include': expected a file or a list of files, found " + Found(file));
    }
  }
  return files;
}

/// Lays `root` over the files that it includes, and these over theirs. `open` are the files that
/// are being read, outermost first; `layer` counts the layers so far.
YamlNode WithIncludes(YamlNode root, const fs::path& folder, std::vector<fs::path>& open,
                      int& layer) {
  constexpr std::size_t kDeepest = 16;
  YamlNode base;
  base.type = YamlNode::Type::kMap;
  for (const YamlNode& file : IncludesOf(root)) {
    std::error_code error;
    const fs::path path = (folder / file.text).lexically_normal();
    const fs::path whole = fs::weakly_canonical(path, error);
    if (error || !fs::is_regular_file(whole, error)) {
      Fail(file.at, "'/include': there is no file '" + Shown(path.string()) + "'");
    }
    if (std::find(open.begin(), open.end(), whole) != open.end()) {
      Fail(file.at, "'/include': '" + Shown(file.text) + "' includes itself in the end");
    }
    if (open.size() >= kDeepest) Fail(file.at, "'/include': more than 16 files deep");
    open.push_back(whole);
    Merge(WithIncludes(LoadYamlFile(path), path.parent_path(), open, layer), base);
    open.pop_back();
  }
  SetLayer(++layer, root);
  root.Erase("include");
  base.at = root.at;
  Merge(root, base);
  return base;
}

/// Puts the robot's own sections below those of the scenario.
void LayOverRobot(const LoadedRobotFile& robot, YamlNode& root) {
  Problems problems;
  bool wanted = true;
  if (const YamlNode* key = root.Find("robot_defaults")) {
    wanted = ReadFlag(*key, "/robot_defaults", problems).value_or(true);
  }
  if (!wanted) return;
  YamlNode base;
  base.type = YamlNode::Type::kMap;
  base.at = root.at;
  for (const char* section : {"drive", "sensors", "nominal"}) {
    if (const YamlNode* values = robot.root.Find(section)) base.Add(section, *values);
  }
  Merge(root, base);
  root = std::move(base);
}

std::string RobotName(const YamlNode& root) {
  const YamlNode* name = root.Find("robot");
  if (name == nullptr) return Scenario{}.robot;
  Problems problems;
  const auto text = ReadText(*name, "/robot", problems);
  problems.ThrowIfAny();
  return *text;
}

Location WhereOf(const YamlNode& root, const char* key) {
  const YamlNode* node = root.Find(key);
  return node != nullptr ? node->at : root.at;
}

/// Fills in what depends on other keys.
void Complete(const YamlNode& root, const fs::path& folder, Scenario& scenario) {
  if (root.Find("estimators") == nullptr) {
    scenario.estimators["inekf"].noise = scenario.nominal.noise;
  }
  if (root.At("/record/truth_rate_hz") == nullptr) {  // the default need not divide another step
    const double rate = 1.0 / scenario.world.physics_step_s;
    const double steps = std::max(1.0, std::round(rate / scenario.record.truth_rate_hz));
    scenario.record.truth_rate_hz = rate / steps;
  }
  const bool swims = sim::KindOf(scenario.drive) == sim::DriveKind::kUnderwater;
  if (swims && !scenario.world.water) scenario.world.water.emplace();
  for (auto& [name, estimator] : scenario.estimators) {
    if (estimator.noise_source == NoiseSource::kMatched) estimator.noise = MatchedNoise(scenario);
    if (estimator.type == "process") {
      const fs::path from = fs::current_path() / folder / estimator.working_folder;
      estimator.working_folder = from.lexically_normal().string();
    }
  }
}

/// A path of the scenario file as one that holds from anywhere.
std::string WholePath(const fs::path& folder, const std::string& path) {
  return fs::absolute(folder / path).lexically_normal().string();
}

/// A scenario that a log stands behind in place of a robot and a world.
Scenario ResolveLog(YamlNode root, const fs::path& folder) {
  Scenario scenario;
  Problems problems;
  const auto text = ReadText(*root.Find("log"), "/log", problems);
  problems.ThrowIfAny();
  const LoadedLog log = LoadLog(WholePath(folder, *text));
  YamlNode base;
  base.type = YamlNode::Type::kMap;
  base.at = root.at;
  if (const YamlNode* nominal = log.root.Find("nominal")) base.Add("nominal", *nominal);
  Merge(root, base);
  ReadDocument(base, problems, scenario);
  problems.ThrowIfAny();
  scenario.log = WholePath(folder, *text);
  scenario.robot = log.folder.filename().string();
  scenario.sensors = SensorsOf(log.values);
  scenario.world.gravity_m_s2 = log.values.gravity_m_s2;
  Complete(base, folder, scenario);
  CheckLogScenario(scenario, base, problems);
  problems.ThrowIfAny();
  return scenario;
}

Scenario Resolve(YamlNode root, const fs::path& folder, int layer,
                 const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) ApplyOverride(text, ++layer, root);
  if (const YamlNode* log = root.Find("log"); log != nullptr && log->text != "") {
    return ResolveLog(std::move(root), folder);
  }
  const LoadedRobotFile robot = LoadRobotFile(RobotName(root), WhereOf(root, "robot"));
  LayOverRobot(robot, root);

  Scenario scenario;
  Problems problems;
  ReadDocument(root, problems, scenario);
  if (const YamlNode* include = root.Find("include")) {
    problems.Add(include->at, "'/include': only a file can include files");
  }
  problems.ThrowIfAny();
  if (!scenario.recording.empty()) scenario.recording = WholePath(folder, scenario.recording);
  Complete(root, folder, scenario);
  const fs::path urdf_path = robot.folder / robot.values.urdf;
  try {
    CheckScenario(scenario, models::UrdfRobot::FromFile(urdf_path.string()), robot.values.base_link,
                  root, problems);
  } catch (const std::invalid_argument& error) {
    Fail(WhereOf(robot.root, "urdf"), error.what());
  }
  problems.ThrowIfAny();
  return scenario;
}

Scenario ReadTree(YamlNode root, const fs::path& path, const std::vector<std::string>& overrides) {
  std::error_code error;
  std::vector<fs::path> open{fs::weakly_canonical(path, error)};
  int layer = 0;  // of the robot's own sections
  root = WithIncludes(std::move(root), path.parent_path(), open, layer);
  return Resolve(std::move(root), path.parent_path(), layer, overrides);
}

}  // namespace

Scenario ReadScenario(const std::string& path, const std::vector<std::string>& overrides) {
  return ReadTree(LoadYamlFile(path), path, overrides);
}

Scenario ReadScenarioText(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides) {
  return ReadTree(ParseYamlFile(text, name), name, overrides);
}

std::string CheckText(const std::string& path, const std::vector<std::string>& overrides) {
  return WriteScenario(ReadScenario(path, overrides));
}

}  // namespace reckon::harness
