#include "reckon/harness/scenario_paths.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>

#include "reckon/harness/yaml_values.h"

namespace reckon::harness {

namespace fs = std::filesystem;

std::string ScenarioName(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  fs::path below = whole.filename();
  for (fs::path folder = whole.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (folder.filename() == "scenarios") return below.replace_extension().generic_string();
    below = folder.filename() / below;
  }
  return whole.stem().string();
}

std::vector<fs::path> HomeFolders() {
  std::vector<fs::path> folders;
  const char* home = std::getenv("RECKON_HOME");  // NOLINT(concurrency-mt-unsafe)
  if (home != nullptr && *home != '\0') folders.emplace_back(home);
  folders.emplace_back(RECKON_SOURCE_DIR);
  return folders;
}

std::vector<std::string> RobotNames() {
  std::set<std::string> names;
  for (const fs::path& home : HomeFolders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(home / "models", error)) {
      if (fs::exists(entry.path() / "robot.yaml", error)) {
        names.insert(entry.path().filename().string());
      }
    }
  }
  return {names.begin(), names.end()};
}

std::optional<fs::path> FindRobot(const std::string& name) {
  if (!IsName(name)) return std::nullopt;
  for (const fs::path& home : HomeFolders()) {
    std::error_code error;
    fs::path folder = home / "models" / name;
    if (fs::exists(folder / "robot.yaml", error)) return folder;
  }
  return std::nullopt;
}

std::vector<fs::path> ScenarioFiles() {
  std::set<fs::path> files;
  for (const fs::path& home : HomeFolders()) {
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(home / "scenarios", error)) {
      if (entry.path().extension() == ".yaml")
        files.insert(fs::relative(entry.path(), home, error));
    }
  }
  return {files.begin(), files.end()};
}

}  // namespace reckon::harness
