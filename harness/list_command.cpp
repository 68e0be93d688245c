#include "reckon/harness/list_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "reckon/ground_truth/metrics.h"
#include "reckon/harness/describe_choices.h"
#include "reckon/harness/nearest.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/scenario_paths.h"
#include "reckon/harness/yaml_load.h"
#include "reckon/sim/imu_grades.h"

namespace reckon::harness {
namespace {

struct Entry {
  std::string name, description;
  std::vector<std::string> blank;  ///< grades: fields without a source, which are zero
};

struct Section {
  std::string name;
  std::vector<Entry> entries;
};

Section Robots() {
  Section section{"robots", {}};
  for (const std::string& name : RobotNames()) {
    std::string description;
    try {
      description = LoadRobotFile(name, {}).values.description;
    } catch (const InputError& error) {
      description = std::string("broken: ") + error.what();
    }
    section.entries.push_back({name, description, {}});
  }
  return section;
}

template <class T>
Section Words(const char* name, std::span<const Choice<T>> choices) {
  Section section{name, {}};
  for (const auto& choice : choices) section.entries.push_back({choice.name, choice.doc, {}});
  return section;
}

Section Grades() {
  Section section{"grades", {}};
  for (const sim::ImuGrade& grade : sim::ImuGrades()) {
    Entry entry{std::string(grade.name), std::string(grade.source), {}};
    if (!grade.alias.empty()) entry.description += fmt::format(" (also: {})", grade.alias);
    entry.blank = sim::BlankFields(grade);
    section.entries.push_back(entry);
  }
  for (const auto& grade : DvlGrades()) {
    section.entries.push_back({grade.name, "a Doppler log: " + grade.doc, {}});
  }
  return section;
}

Section MetricSection() {
  Section section{"metrics", {}};
  const auto metrics = ground_truth::MetricCatalogue({"<sensor>"}, {}, {"<foot>"});
  for (const auto& metric : metrics.list()) {
    const std::string unit = metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit);
    section.entries.push_back({metric.name, metric.meaning + unit, {}});
  }
  return section;
}

Section Scenarios() {
  Section section{"scenarios", {}};
  for (const auto& file : ScenarioFiles()) {
    Entry entry{file.generic_string(), "", {}};
    for (const auto& home : HomeFolders()) {
      if (!std::filesystem::exists(home / file)) continue;
      try {
        const YamlNode root = LoadYamlFile(home / file);
        const YamlNode* description = root.Find("description");
        if (description != nullptr) entry.description = description->text;
      } catch (const InputError& error) {
        entry.description = std::string("broken: ") + error.what();
      }
      break;
    }
    section.entries.push_back(entry);
  }
  return section;
}

std::vector<Section> Sections() {
  return {Robots(),
          Words("estimators", std::span(EstimatorTypes())),
          Words("sensors", Choices<sim::SensorType>()),
          Grades(),
          Words("terrains", Choices<sim::TerrainKind>()),
          Words("motions", Choices<sim::PathKind>()),
          Words("missions", Choices<sim::MissionKind>()),
          Words("faults", Choices<sim::FaultKind>()),
          MetricSection(),
          Scenarios()};
}

std::string SectionText(const Section& section) {
  std::size_t width = 0;
  for (const Entry& entry : section.entries) width = std::max(width, entry.name.size());
  std::string text = section.name + "\n";
  for (const Entry& entry : section.entries) {
    text += fmt::format("  {:{}}  {}", entry.name, width, entry.description);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
    if (entry.blank.empty()) continue;
    text += fmt::format("  {:{}}  blank, so zero: {}\n", "", width, fmt::join(entry.blank, " "));
  }
  return text;
}

/// The section called `what`, or all.
std::vector<Section> Wanted(const std::string& what) {
  std::vector<Section> all = Sections();
  if (what.empty()) return all;
  std::vector<std::string> names;
  for (const Section& section : all) {
    if (section.name == what) return {section};
    names.push_back(section.name);
  }
  throw InputError(fmt::format("reckon list: there is no '{}'{}; there are {}", what,
                               DidYouMean(what, names), fmt::join(names, ", ")));
}

}  // namespace

std::string ListText(const std::string& what) {
  std::string text;
  for (const Section& section : Wanted(what)) {
    text += (text.empty() ? "" : "\n") + SectionText(section);
  }
  return text;
}

std::string ListJson(const std::string& what) {
  nlohmann::ordered_json all;
  for (const Section& section : Wanted(what)) {
    auto& entries = all[section.name] = nlohmann::ordered_json::array();
    for (const Entry& entry : section.entries) {
      nlohmann::ordered_json item = {{"name", entry.name}, {"description", entry.description}};
      if (section.name == "grades") item["blank"] = entry.blank;
      entries.push_back(std::move(item));
    }
  }
  return all.dump(2) + "\n";
}

}  // namespace reckon::harness
