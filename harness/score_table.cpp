#include "reckon/harness/score_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace reckon::harness {
namespace {

struct TableColumn {
  std::string_view title, unit, metric;
};

constexpr std::array<TableColumn, 8> kColumns{{
    {"position", "ATE m", "ate_position_rmse_m"},
    {"heading+tilt", "ATE deg", "ate_orientation_rmse_deg"},
    {"velocity", "ATE m/s", "ate_velocity_rmse_m_s"},
    {"RPE 1 m", "m", "rpe_1m_translation_rmse"},
    {"drift", "% of path", "final_drift_percent"},
    {"NEES ori", "3 is honest", "nees_orientation_mean"},
    {"NEES vel", "3 is honest", "nees_velocity_mean"},
    {"NEES pos", "3 is honest", "nees_position_mean"},
}};

std::string Number(std::optional<double> value) {
  if (!value) return "-";
  return std::abs(*value) < 1e5 && (std::abs(*value) >= 1e-3 || *value == 0.0)
             ? fmt::format("{:.4g}", *value)
             : fmt::format("{:.2e}", *value);
}

std::string Header(const RunResult& result) {
  const Costs& costs = result.costs;
  std::string text = fmt::format("{}  seed {}", result.scenario, result.seed);
  if (result.resumed) {
    text += "  (finished before)";
  } else if (costs.wall_s > 0.0 && costs.simulated_s > 0.0) {
    text += fmt::format("  {:g} s in {:.2f} s ({:.0f} times real time)", costs.simulated_s,
                        costs.wall_s, costs.real_time_factor());
  }
  return text + fmt::format("\n  {}\n", result.folder.string());
}

std::string Rows(const RunResult& result) {
  std::size_t width = 9;
  for (const auto& score : result.scores) width = std::max(width, score.name.size());
  std::string text = fmt::format("  {:<{}}", "estimator", width);
  std::string units = fmt::format("  {:<{}}", "", width);
  for (const auto& column : kColumns) {
    text += fmt::format("  {:>12}", column.title);
    units += fmt::format("  {:>12}", column.unit);
  }
  text += fmt::format("  {:>9}\n", "a message") + units + fmt::format("  {:>9}\n", "us");
  for (const auto& score : result.scores) {
    text += fmt::format("  {:<{}}", score.name, width);
    for (const auto& column : kColumns) {
      text += fmt::format("  {:>12}", Number(score.metrics.Find(column.metric)));
    }
    const auto cost = result.costs.estimators.find(score.name);
    const bool known = cost != result.costs.estimators.end();
    text += fmt::format("  {:>9}\n", known ? fmt::format("{:.2f}", cost->second.mean_us()) : "-");
  }
  return text;
}

std::string Verdicts(const RunResult& result, const std::string& command, bool color) {
  const auto paint = [color](std::string_view code, std::string_view text) {
    return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
  };
  std::string text;
  std::size_t held = 0;
  for (const auto& verdict : result.verdicts) {
    held += verdict.holds ? 1 : 0;
    if (verdict.holds) continue;
    text +=
        fmt::format("  {} {}: {}\n", paint("31", "FAILED"), verdict.expectation, verdict.detail);
  }
  if (!result.verdicts.empty()) {
    const bool all = held == result.verdicts.size();
    text +=
        fmt::format("  {} {} of {} expectations hold\n",
                    paint(all ? "32" : "31", all ? "ok" : "not ok"), held, result.verdicts.size());
  }
  if (result.expected_exit_code) {
    const bool met = result.exit_code() == 0;
    text +=
        fmt::format("  {} this run must end with exit code {}\n",
                    paint(met ? "32" : "31", met ? "ok" : "FAILED"), *result.expected_exit_code);
  }
  if (result.exit_code() != 0) text += fmt::format("  repeat it with: {}\n", command);
  return text;
}

}  // namespace

std::string ScoreTable(const RunResult& result, const std::string& command, bool color) {
  std::string text = Header(result);
  if (result.outcome == Outcome::kFailed) text += fmt::format("  FAILED: {}\n", result.failure);
  if (!result.scores.empty()) text += Rows(result);
  return text + Verdicts(result, command, color);
}

}  // namespace reckon::harness
