#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reckon::harness {

/// The flags of `reckon run`.
struct RunArguments {
  std::vector<std::string> scenarios;
  std::vector<std::string> overrides;   ///< `a.b=c`, in order
  std::vector<std::string> estimators;  ///< only these; empty: all
  std::optional<std::uint64_t> seed;
  std::filesystem::path out = "out";
  int jobs = 1;
  bool json = false;
  bool quiet = false;
  bool force = false;
  bool resume = false;
  bool replay = false;  ///< `scenarios` are logs, as ReadReplay takes them
};

/// Runs every scenario on `jobs` threads, prints what came out in the order of the command line and
/// returns the worst exit code (2 before 3 before 1). Ctrl-C ends all runs cleanly.
int RunCommand(const RunArguments& arguments);

/// The flags of `reckon score`.
struct ScoreArguments {
  std::vector<std::string> results;
  std::vector<std::string> overrides;  ///< only below `score.` and `expect.`
  bool json = false;
  bool quiet = false;
};

/// Scores recordings again, without simulation, and replaces their metrics.json.
int ScoreCommand(const ScoreArguments& arguments);

}  // namespace reckon::harness
