#include "reckon/harness/replay_input.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "reckon/harness/log_file.h"
#include "reckon/harness/scenario_paths.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;

bool IsResult(const fs::path& path) {
  return fs::exists(path / "resolved.yaml") && fs::exists(path / "recording.h5");
}

std::string Quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// The last part of a path that may end with a slash.
std::string FolderName(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

Scenario ReadReplay(const fs::path& path, const std::vector<std::string>& overrides) {
  if (fs::exists(path / "log.yaml")) {
    const std::string text = fmt::format("log: {}\nestimators: {{riekf: {{type: inekf}}}}\n",
                                         Quoted(fs::absolute(path).string()));
    return ReadScenarioText(text, path.string(), overrides);
  }
  if (IsResult(path)) {
    std::vector<std::string> all = overrides;
    all.push_back("recording=" + Quoted(fs::absolute(path / "recording.h5").string()));
    return ReadScenario((path / "resolved.yaml").string(), all);
  }
  if (fs::is_directory(path) || !fs::exists(path)) {
    throw LogMissing(
        fmt::format("there is no log '{}': neither log.yaml nor recording.h5", path.string()));
  }
  Scenario scenario = ReadScenario(path.string(), overrides);
  if (scenario.log.empty() && scenario.recording.empty()) {
    throw InputError(
        fmt::format("{}: error: this scenario has no 'log' to replay; 'reckon run' "
                    "simulates it",
                    path.string()));
  }
  return scenario;
}

std::string ReplayName(const fs::path& path) {
  if (fs::exists(path / "log.yaml")) return "logs/" + FolderName(path);
  if (!IsResult(path)) return ScenarioName(path);
  std::ifstream file(path / "run.json");
  const auto run = nlohmann::json::parse(file, nullptr, false);
  return "replay/" + (run.is_object() ? run.value("scenario", FolderName(path)) : FolderName(path));
}

}  // namespace reckon::harness
