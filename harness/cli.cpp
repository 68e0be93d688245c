#include "reckon/harness/cli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

#include "reckon/build_info.h"
#include "reckon/harness/list_command.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/nearest.h"
#include "reckon/harness/results_folder.h"
#include "reckon/harness/run_command.h"
#include "reckon/harness/schema.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

struct CheckArguments {
  std::vector<std::string> scenarios;
  std::vector<std::string> overrides;
  bool schema = false;
  bool quiet = false;
};

struct ListArguments {
  std::string what;
  bool json = false;
};

/// The parser itself takes -1 for the largest of all numbers.
std::string WholeNumber(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? "" : "expected a whole number of at least 0, found '" + text + "'";
}

void AddRunFlags(CLI::App& command, RunArguments& run) {
  command.add_option("--set", run.overrides, "Override a key: a.b=c (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", run.seed, "Another seed")->check(WholeNumber);
  command.add_option("--estimator", run.estimators, "Run only this estimator (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command.add_option("--out", run.out, "Folder of the results")->capture_default_str();
  command.add_option("--jobs", run.jobs, "Scenarios that run at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_flag("--json", run.json, "Machine-readable results on stdout");
  command.add_flag("--quiet", run.quiet, "No progress and no warnings");
  command.add_flag("--force", run.force, "Replace a folder that is not a result of this scenario");
  command.add_flag("--resume", run.resume, "Keep finished results of the same resolved scenario");
}

void AddRun(CLI::App& app, RunArguments& run) {
  CLI::App* command = app.add_subcommand("run", "Run scenarios, score them, write their results");
  command->add_option("scenario", run.scenarios, "Scenario files")->required();
  AddRunFlags(*command, run);
}

void AddReplay(CLI::App& app, RunArguments& run) {
  CLI::App* command = app.add_subcommand(
      "replay", "Run estimators over recorded measurements in place of the simulator");
  command
      ->add_option("log", run.scenarios,
                   "Folders with a log.yaml, result folders, or scenarios with a log")
      ->required();
  AddRunFlags(*command, run);
}

void AddScore(CLI::App& app, ScoreArguments& score) {
  CLI::App* command =
      app.add_subcommand("score", "Score recordings again and replace their metrics.json");
  command->add_option("results", score.results, "Result folders")->required();
  command->add_option("--set", score.overrides, "Override a key below score. or expect.")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--json", score.json, "Machine-readable results on stdout");
  command->add_flag("--quiet", score.quiet, "No warnings");
}

void AddCheck(CLI::App& app, CheckArguments& check) {
  CLI::App* command =
      app.add_subcommand("check", "Validate scenarios and print them with every default");
  command->add_option("scenario", check.scenarios, "Scenario files");
  command->add_option("--set", check.overrides, "Override a key: a.b=c (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--schema", check.schema, "Print the JSON Schema of scenario files");
  command->add_flag("--quiet", check.quiet, "Only say what is wrong");
}

void AddList(CLI::App& app, ListArguments& list) {
  CLI::App* command = app.add_subcommand(
      "list", "List robots, estimators, sensors, grades, terrains, motions, metrics, scenarios");
  command->add_option("what", list.what, "Only this kind");
  command->add_flag("--json", list.json, "Machine-readable");
}

int Check(const CheckArguments& arguments) {
  if (arguments.schema) {
    fmt::print("{}", JsonSchema());
    return kExitHolds;
  }
  if (arguments.scenarios.empty()) {
    fmt::print(stderr, "reckon check: name at least one scenario file, or --schema\n");
    return kExitBadInput;
  }
  int code = kExitHolds;
  for (const std::string& path : arguments.scenarios) {
    try {
      const std::string resolved = CheckText(path, arguments.overrides);
      if (!arguments.quiet) fmt::print("{}", resolved);
    } catch (const LogMissing& missing) {
      fmt::print(stderr, "{}: skipped: {}\n", path, missing.what());
      if (code == kExitHolds) code = kExitSkipped;
    } catch (const InputError& error) {
      fmt::print(stderr, "{}\n", error.what());
      code = kExitBadInput;
    }
  }
  return code;
}

/// What the parser found wrong, with the nearest name when a command or a flag is unknown.
std::string ParseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           const std::vector<std::string>& arguments) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first.empty()) return error.what();
  if (std::find(commands.begin(), commands.end(), first) == commands.end()) {
    return fmt::format("there is no command '{}'{}", first, DidYouMean(first, commands));
  }
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_subcommand(first)->get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    const std::string flag = argument.substr(0, argument.find('='));
    if (!flag.starts_with("--") || std::find(flags.begin(), flags.end(), flag) != flags.end()) {
      continue;
    }
    return fmt::format("'reckon {}' has no flag '{}'{}", first, flag, DidYouMean(flag, flags));
  }
  return error.what();
}

int ReportParseError(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  fmt::print(stderr, "reckon: {}\n'reckon --help' lists the commands\n",
             ParseErrorText(app, error, {argv + std::min(argc, 1), argv + argc}));
  return kExitBadInput;
}

/// Hands what was printed to the system; a full disk must not pass for success.
int FlushResults(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  fmt::print(stderr, "reckon: can't write to standard output\n");
  return code == kExitBadInput ? code : int{kExitRunFailed};
}

}  // namespace

int RunCommandLine(int argc, char** argv) {
  CLI::App app("Simulation-in-the-loop test harness for proprioceptive robot state estimators",
               "reckon");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("reckon " RECKON_VERSION));
  RunArguments run, replay;
  replay.replay = true;
  ScoreArguments score;
  CheckArguments check;
  ListArguments list;
  AddRun(app, run);
  AddReplay(app, replay);
  AddScore(app, score);
  AddCheck(app, check);
  AddList(app, list);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that hits its limit is an error, as a full disk is
  try {
    app.parse(argc, argv);
    if (app.got_subcommand("run")) return FlushResults(RunCommand(run));
    if (app.got_subcommand("replay")) return FlushResults(RunCommand(replay));
    if (app.got_subcommand("score")) return FlushResults(ScoreCommand(score));
    if (app.got_subcommand("check")) return FlushResults(Check(check));
    fmt::print("{}", list.json ? ListJson(list.what) : ListText(list.what));
    return FlushResults(kExitHolds);
  } catch (const CLI::ParseError& error) {
    return ReportParseError(app, error, argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kExitBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "reckon: {}\n", error.what());
    return kExitRunFailed;
  }
}

}  // namespace reckon::harness
