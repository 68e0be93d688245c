#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/ground_truth/metrics.h"
#include "reckon/harness/costs.h"
#include "reckon/harness/expectations.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

enum class Outcome : std::uint8_t {
  kFinished,     ///< ran to its end
  kFailed,       ///< the physics or an estimator failed; the result folder says so
  kInterrupted,  ///< stopped from outside; nothing was left
};

struct RunOptions {
  std::filesystem::path out = "out";
  bool force = false;   ///< replace a folder that is not a result of this scenario and seed
  bool resume = false;  ///< keep a finished result of the same resolved scenario
  std::string command;  ///< the command that repeats this run, for run.json
  const std::atomic<bool>* stop = nullptr;                    ///< ends the run when it turns true
  std::function<void(double fraction, double rtf)> progress;  ///< called now and then
  bool poison_truth = false;  ///< truth turns to NaN once the priors are drawn (a test of leaks)
};

/// What one estimator scored.
struct EstimatorScore {
  std::string name;
  ground_truth::Metrics metrics;
};

struct RunResult {
  std::string scenario;
  std::uint64_t seed = 0;
  std::filesystem::path folder;
  Outcome outcome = Outcome::kFinished;
  std::string failure;  ///< why it failed
  std::vector<EstimatorScore> scores;
  std::vector<Verdict> verdicts;
  std::optional<int> expected_exit_code;  ///< `expect: exit_code:`
  Costs costs;
  std::vector<std::string> score_overrides;  ///< of scoring again
  bool resumed = false;                      ///< read back, not run

  /// 0, 1 or 3 as the command line means them. A run that had to end with another code than 0 and
  /// did is one whose expectations hold.
  int exit_code() const;
};

/// Runs `scenario` and writes its result folder `<out>/<name>/seed_<seed>`. A pure function of the
/// resolved scenario but for wall times. Throws OutputError if the result can't be written and
/// std::invalid_argument if the robot, world or an estimator can't be built.
RunResult RunScenario(const Scenario& scenario, const std::string& name, const RunOptions& options);

/// Scores the recording in a result folder again, with `overrides` of `score:` and `expect:`, which
/// metrics.json then names. Replaces metrics.json, the trajectories and run.json's expectations,
/// all or nothing. Throws std::invalid_argument if `folder` is no result or its recording lacks
/// truth or estimates.
RunResult ScoreResults(const std::filesystem::path& folder,
                       const std::vector<std::string>& overrides);

}  // namespace reckon::harness
