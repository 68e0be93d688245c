#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reckon::harness {

/// The name of a scenario file: its path below the nearest folder called `scenarios`, without
/// extension (`husky/square`); the file's own name if there is no such folder.
std::string ScenarioName(const std::filesystem::path& path);

/// The folders that hold `models/` and `scenarios/`: $RECKON_HOME if it is set, and the sources
/// that the program was built from.
std::vector<std::filesystem::path> HomeFolders();

/// The robots: folders of models/ with a robot.yaml, sorted.
std::vector<std::string> RobotNames();

/// The folder of a robot; nothing if there is none of that name.
std::optional<std::filesystem::path> FindRobot(const std::string& name);

/// All scenario files below scenarios/, sorted by name; the path is relative to the home folder.
std::vector<std::filesystem::path> ScenarioFiles();

}  // namespace reckon::harness
