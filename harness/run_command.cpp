#include "reckon/harness/run_command.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "reckon/harness/cli.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/nearest.h"
#include "reckon/harness/progress.h"
#include "reckon/harness/remarks.h"
#include "reckon/harness/replay_input.h"
#include "reckon/harness/results_folder.h"
#include "reckon/harness/run.h"
#include "reckon/harness/run_json.h"
#include "reckon/harness/score_table.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else

extern "C" void OnInterrupt(int /*signal*/) { interrupted = true; }

/// Restores the previous handlers when it goes.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupted = false;
    previous_int_ = std::signal(SIGINT, OnInterrupt);
    previous_term_ = std::signal(SIGTERM, OnInterrupt);
  }
  ~InterruptGuard() {
    std::signal(SIGINT, previous_int_);
    std::signal(SIGTERM, previous_term_);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*previous_int_)(int);
  void (*previous_term_)(int);
};

/// What one scenario of the command line came to.
struct Job {
  std::string path;
  std::string command;  ///< repeats it
  std::optional<RunResult> result;
  std::string error;
  int code = kExitHolds;
};

/// Quotes an argument for a shell where that is needed.
std::string Quoted(const std::string& argument) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  std::string quoted = "'";
  for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string RepeatCommand(const std::string& path, const RunArguments& arguments) {
  std::string command = (arguments.replay ? "reckon replay " : "reckon run ") + Quoted(path);
  if (arguments.seed) command += fmt::format(" --seed {}", *arguments.seed);
  for (const auto& text : arguments.overrides) command += " --set " + Quoted(text);
  for (const auto& name : arguments.estimators) command += " --estimator " + Quoted(name);
  if (arguments.out != RunArguments().out) command += " --out " + Quoted(arguments.out);
  return command;
}

/// Drops the estimators that were not asked for, with what is expected of them.
void KeepEstimators(const std::vector<std::string>& wanted, Scenario& scenario) {
  if (wanted.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, config] : scenario.estimators) names.push_back(name);
  for (const auto& name : wanted) {
    if (scenario.estimators.contains(name)) continue;
    const auto nearest = Nearest(name, names);
    throw std::invalid_argument(
        fmt::format("--estimator {}: the scenario has no such estimator{}", name,
                    nearest ? fmt::format("; did you mean '{}'?", *nearest) : std::string()));
  }
  const auto unwanted = [&wanted](const std::string& name) {
    return std::find(wanted.begin(), wanted.end(), name) == wanted.end();
  };
  std::erase_if(scenario.estimators, [&](const auto& entry) { return unwanted(entry.first); });
  std::erase_if(scenario.expect.estimators,
                [&](const auto& entry) { return unwanted(entry.first); });
  std::erase_if(scenario.expect.compare, [&](const Comparison& comparison) {
    return unwanted(comparison.left_estimator) || unwanted(comparison.right_estimator);
  });
}

std::string NameOf(const std::string& path, const RunArguments& arguments) {
  return arguments.replay ? ReplayName(path) : ScenarioName(path);
}

void RunJob(const RunArguments& arguments, Progress& progress, Job& job) {
  try {
    std::vector<std::string> overrides = arguments.overrides;
    if (arguments.seed) overrides.push_back(fmt::format("seed={}", *arguments.seed));
    Scenario scenario =
        arguments.replay ? ReadReplay(job.path, overrides) : ReadScenario(job.path, overrides);
    KeepEstimators(arguments.estimators, scenario);
    const std::string name = NameOf(job.path, arguments);
    RunOptions options;
    options.out = arguments.out;
    options.force = arguments.force;
    options.resume = arguments.resume;
    options.command = job.command;
    options.stop = &interrupted;
    options.progress = [&progress, name](double fraction, double factor) {
      progress.Update(name, fraction, factor);
    };
    job.result = RunScenario(scenario, name, options);
    job.code = job.result->outcome == Outcome::kInterrupted ? int{kExitInterrupted}
                                                            : job.result->exit_code();
  } catch (const LogMissing& missing) {
    job.error = fmt::format("{}: skipped: {}", job.path, missing.what());
    job.code = kExitSkipped;
  } catch (const InputError& error) {
    job.error = error.what();
    job.code = kExitBadInput;
  } catch (const std::invalid_argument& error) {
    job.error = fmt::format("{}: error: {}", job.path, error.what());
    job.code = kExitBadInput;
  } catch (const std::exception& error) {
    job.error = fmt::format("{}: {}", job.path, error.what());
    job.code = kExitRunFailed;
  }
}

/// Worse codes later: 0, 77, 1, 3, 2; an interrupt beats them all.
int Severity(int code) {
  constexpr std::array<int, 5> kOrder{kExitHolds, kExitSkipped, kExitExpectationFailed,
                                      kExitRunFailed, kExitBadInput};
  return static_cast<int>(std::find(kOrder.begin(), kOrder.end(), code) - kOrder.begin());
}

bool WantsColor() {
  return std::getenv("NO_COLOR") == nullptr;  // NOLINT(concurrency-mt-unsafe)
}

/// Warnings on stderr, in colour where a terminal shows it.
spdlog::logger MakeLog() {
  const auto mode = WantsColor() ? spdlog::color_mode::automatic : spdlog::color_mode::never;
  spdlog::logger log("reckon", std::make_shared<spdlog::sinks::stderr_color_sink_mt>(mode));
  log.set_pattern("%^%l%$: %v");
  return log;
}

int Print(const std::vector<Job>& jobs, bool json, bool quiet) {
  spdlog::logger log = MakeLog();
  int worst = kExitHolds;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Job& job : jobs) {
    if (Severity(job.code) > Severity(worst)) worst = job.code;
    if (!job.error.empty()) fmt::print(stderr, "{}\n", job.error);
    if (!job.result || job.result->outcome == Outcome::kInterrupted) continue;
    if (json) {
      all.push_back(SummaryJson(*job.result, job.command));
    } else {
      fmt::print(
          "{}", ScoreTable(*job.result, job.command, ::isatty(STDOUT_FILENO) != 0 && WantsColor()));
    }
    if (quiet) continue;
    for (const auto& remark : Remarks(*job.result)) {
      log.warn("{}: {}", job.result->scenario, remark);
    }
  }
  if (json) fmt::print("{}\n", all.dump(2));
  if (worst == kExitInterrupted) fmt::print(stderr, "interrupted; nothing was left half-written\n");
  return worst;
}

/// Two scenarios of one call must not write into one folder.
void RefuseCollisions(const RunArguments& arguments) {
  std::set<std::string> names;
  for (const auto& path : arguments.scenarios) {
    const std::string name = NameOf(path, arguments);
    if (!names.insert(name).second) {
      throw InputError(
          fmt::format("{}: error: another scenario of this call has the same name "
                      "'{}' and would write into the same folder",
                      path, name));
    }
  }
}

}  // namespace

int RunCommand(const RunArguments& arguments) {
  RefuseCollisions(arguments);
  const InterruptGuard guard;
  Progress progress(arguments.quiet);
  std::vector<Job> jobs;
  for (const auto& path : arguments.scenarios) {
    jobs.push_back({path, RepeatCommand(path, arguments), std::nullopt, "", kExitHolds});
  }
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size() && !interrupted; i = next++) {
      RunJob(arguments, progress, jobs[i]);
    }
  };
  const std::size_t threads = std::min<std::size_t>(arguments.jobs, jobs.size());
  std::vector<std::jthread> pool;
  for (std::size_t i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  pool.clear();
  progress.Clear();
  for (Job& job : jobs) {
    if (interrupted && !job.result && job.error.empty()) job.code = kExitInterrupted;
  }
  return Print(jobs, arguments.json, arguments.quiet);
}

int ScoreCommand(const ScoreArguments& arguments) {
  for (const std::string& text : arguments.overrides) {
    if (text.starts_with("score.") || text.starts_with("expect.")) continue;
    throw InputError(fmt::format(
        "--set {}: error: a recording can't change; expected a key below 'score.' or 'expect.'",
        text));
  }
  std::vector<Job> jobs;
  for (const auto& folder : arguments.results) {
    Job& job = jobs.emplace_back();
    job.path = folder;
    job.command = "reckon score " + Quoted(folder);
    for (const auto& text : arguments.overrides) job.command += " --set " + Quoted(text);
    try {
      job.result = ScoreResults(folder, arguments.overrides);
      job.code = job.result->exit_code();
    } catch (const InputError& error) {
      job.error = error.what();
      job.code = kExitBadInput;
    } catch (const std::invalid_argument& error) {
      job.error = fmt::format("{}: error: {}", folder, error.what());
      job.code = kExitBadInput;
    } catch (const std::exception& error) {
      job.error = fmt::format("{}: {}", folder, error.what());
      job.code = kExitRunFailed;
    }
  }
  return Print(jobs, arguments.json, arguments.quiet);
}

}  // namespace reckon::harness
