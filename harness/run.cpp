#include "reckon/harness/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/build_info.h"
#include "reckon/ground_truth/consistency.h"
#include "reckon/ground_truth/recording_reader.h"
#include "reckon/ground_truth/tum.h"
#include "reckon/harness/csv_log.h"
#include "reckon/harness/experiment.h"
#include "reckon/harness/process_estimator.h"
#include "reckon/harness/recorded_tracks.h"
#include "reckon/harness/recording_log.h"
#include "reckon/harness/replay_experiment.h"
#include "reckon/harness/results_folder.h"
#include "reckon/harness/run_json.h"
#include "reckon/harness/scenario_metrics.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/harness/yaml_writer.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;
using ground_truth::Track;
using Tracks = std::map<std::string, Track>;

constexpr const char* kRecording = "recording.h5";
constexpr const char* kResolved = "resolved.yaml";

std::vector<std::string> SensorNames(const models::Suite& suite) {
  std::vector<std::string> names;
  for (const auto& sensor : suite.sensors) names.push_back(sensor.name);
  return names;
}

models::TimeNs PeriodNs(double rate_hz) {
  return rate_hz > 0.0 ? std::llround(1e9 / rate_hz) : models::TimeNs{0};
}

ground_truth::RecordingPlan PlanOf(const Scenario& scenario, const Robot& robot,
                                   const std::string& resolved) {
  ground_truth::RecordingPlan plan;
  for (const auto& sensor : robot.nominal.sensors) {
    plan.sensors.push_back({sensor, robot.channels[plan.sensors.size()]});
  }
  for (const auto& [name, config] : scenario.estimators) plan.estimators.push_back(name);
  // Legs are no wheels: what their joints do, encoders tell.
  if (robot.feet.empty()) plan.wheels = robot.joints;
  plan.feet = robot.feet;
  plan.truth = scenario.record.truth;
  plan.measurements = scenario.record.measurements;
  plan.estimates = scenario.record.estimates;
  plan.covariance = scenario.record.covariance;
  plan.corrections = scenario.record.innovations;
  plan.truth_period_ns = PeriodNs(scenario.record.truth_rate_hz);
  plan.estimate_period_ns = PeriodNs(scenario.record.estimate_rate_hz);
  plan.attributes = {{"program", "reckon " RECKON_VERSION}, {"resolved_scenario", resolved}};
  return plan;
}

/// Forgets what `score: start_s` leaves out: neither scores nor trajectories hold it.
void DropBeforeStart(const Scenario& scenario, Tracks& tracks) {
  const models::TimeNs start_ns = std::llround(1e9 * scenario.score.start_s);
  for (auto& [name, track] : tracks) track.DropBefore(start_ns);
}

/// Scores every track and judges the expectations.
void ScoreTracks(const Scenario& scenario, const Robot& robot, const Tracks& tracks,
                 RunResult& result) {
  const std::vector<std::string> sensors = SensorNames(robot.nominal);
  result.scores.clear();
  for (const auto& [name, track] : tracks) {
    result.scores.push_back(
        {name, ground_truth::Score(track, sensors, scenario.score, robot.feet)});
  }
  Findings findings;
  findings.metric = [&result](const std::string& estimator,
                              const std::string& metric) -> std::optional<double> {
    for (const auto& score : result.scores) {
      if (score.name == estimator) return score.metrics.Find(metric);
    }
    return std::nullopt;
  };
  findings.inconsistencies = [&](const std::string& estimator, double false_alarm) {
    return ground_truth::Complaints(
        ground_truth::CheckConsistency(tracks.at(estimator), sensors, false_alarm));
  };
  result.verdicts = Judge(scenario.expect, findings);
}

/// One file an estimator, and truth.tum at the stamps of all of them.
void WriteTrajectories(const Tracks& tracks, const fs::path& folder) {
  std::vector<const ground_truth::TrackSample*> truths;
  for (const auto& [name, track] : tracks) {
    if (track.samples().empty()) continue;
    ground_truth::TumWriter estimate(folder / (name + ".tum"));
    for (const auto& sample : track.samples()) {
      estimate.Add(sample.t_ns, sample.X_WB);
      truths.push_back(&sample);
    }
    estimate.Close();
  }
  if (truths.empty()) return;
  const auto earlier = [](const auto* a, const auto* b) { return a->t_ns < b->t_ns; };
  const auto equal = [](const auto* a, const auto* b) { return a->t_ns == b->t_ns; };
  std::stable_sort(truths.begin(), truths.end(), earlier);
  truths.erase(std::unique(truths.begin(), truths.end(), equal), truths.end());
  ground_truth::TumWriter truth(folder / "truth.tum");
  for (const auto* sample : truths) truth.Add(sample->t_ns, sample->X_WB_true);
  truth.Close();
}

/// Scores are of everything that happened; a recording that was told to leave some of it out would
/// silently give others.
void CheckRecordsWhole(const RecordConfig& record) {
  const std::pair<bool, const char*> needed[] = {
      {record.truth, "truth: false"},
      {record.estimates, "estimates: false"},
      {record.covariance, "covariance: false"},
      {record.innovations, "innovations: false"},
      {record.estimate_rate_hz == 0.0, "estimate_rate_hz other than 0"}};
  for (const auto& [kept, key] : needed) {
    if (kept) continue;
    throw std::invalid_argument(
        fmt::format("its recording does not hold all that scores are made of (`record: {{{}}}`); "
                    "run the scenario again without that",
                    key));
  }
}

/// The same for truth: between its rows it is interpolated, and thinned truth would add that error
/// to the scores. At 10 m/s^2 it is 3 um over 1.5 ms, the most that the default rate leaves.
void CheckTruthIsFine(const Scenario& scenario, const Tracks& tracks) {
  constexpr models::TimeNs kFineNs = 1'500'000;
  const models::TimeNs period_ns = PeriodNs(scenario.record.truth_rate_hz);
  if (period_ns <= std::max(kFineNs, PeriodNs(1.0 / scenario.world.physics_step_s))) return;
  for (const auto& [name, track] : tracks) {
    const auto between =
        std::count_if(track.samples().begin(), track.samples().end(),
                      [period_ns](const auto& sample) { return sample.t_ns % period_ns != 0; });
    if (between == 0) continue;
    throw std::invalid_argument(
        fmt::format("its recording does not hold all that scores are made of: of {} estimates of "
                    "'{}', {} lie between the rows of truth (`record: {{truth_rate_hz: {}}}`); run "
                    "the scenario again without that",
                    track.samples().size(), name, between, scenario.record.truth_rate_hz));
  }
}

std::string ReadFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A finished result of the same resolved scenario, as it was; nothing if there is none.
std::optional<RunResult> Finished(const fs::path& folder, const Scenario& scenario,
                                  const std::string& name, const std::string& resolved) {
  if (!IsFinishedResult(folder, name, scenario.seed)) return std::nullopt;
  if (ReadFile(folder / kResolved) != resolved) return std::nullopt;
  std::vector<std::string> sensors;
  for (const auto& [sensor, config] : scenario.sensors) sensors.push_back(sensor);
  auto result =
      ReadRunJson(ReadFile(folder / "run.json"), ReadFile(folder / "metrics.json"),
                  ground_truth::MetricCatalogue(sensors, scenario.score, FeetOf(scenario)));
  if (!result) return std::nullopt;
  result->scenario = name;
  result->seed = scenario.seed;
  result->folder = folder;
  result->expected_exit_code = scenario.expect.exit_code;
  result->resumed = true;
  return result;
}

/// What stands in for the simulator; null if nothing does.
std::unique_ptr<MeasurementLog> LogOf(const Scenario& scenario, const Robot& robot) {
  if (!scenario.log.empty()) {
    return std::make_unique<CsvLog>(LoadLog(scenario.log), robot.nominal);
  }
  if (!scenario.recording.empty()) return std::make_unique<RecordingLog>(scenario.recording);
  return nullptr;
}

/// Runs `experiment` and gives what it scored; what fails in the world or in an estimator becomes
/// the result's failure.
template <class Kind>
Tracks RunExperiment(Kind&& experiment, const RunOptions& options, RunResult& result) {
  Experiment::Hooks hooks{options.progress, options.poison_truth};
  try {
    if (!experiment.Run(hooks)) result.outcome = Outcome::kInterrupted;
  } catch (const sim::WorldFailure& failure) {
    result.failure = failure.what();
  } catch (const EstimatorFailure& failure) {
    result.failure = failure.what();
  } catch (const ProcessFailure& failure) {
    result.failure = failure.what();
  } catch (const ProcessInterrupted&) {
    result.outcome = Outcome::kInterrupted;
  }
  if (!result.failure.empty()) result.outcome = Outcome::kFailed;
  result.costs = experiment.costs();
  return experiment.TakeTracks();
}

fs::path FolderOf(const fs::path& out, const std::string& name, std::uint64_t seed) {
  return out / name / fmt::format("seed_{:05}", seed);
}

}  // namespace

int RunResult::exit_code() const {
  const bool hold = std::all_of(verdicts.begin(), verdicts.end(),
                                [](const Verdict& verdict) { return verdict.holds; });
  const int code = outcome != Outcome::kFinished ? 3 : hold ? 0 : 1;
  if (code == expected_exit_code.value_or(0)) return 0;
  return code == 0 ? 1 : code;
}

RunResult RunScenario(const Scenario& scenario, const std::string& name,
                      const RunOptions& options) {
  LapTimer wall;
  RunResult result;
  result.scenario = name;
  result.seed = scenario.seed;
  result.folder = FolderOf(options.out, name, scenario.seed);
  result.expected_exit_code = scenario.expect.exit_code;
  const std::string resolved = WriteScenario(scenario);
  if (options.resume) {
    if (auto finished = Finished(result.folder, scenario, name, resolved)) return *finished;
  }
  const Robot robot = LoadRobot(scenario);
  ResultsFolder folder(result.folder, name, scenario.seed, options.force);
  folder.Write(kResolved, resolved);
  ground_truth::RunRecorder recorder(folder.File(kRecording), PlanOf(scenario, robot, resolved));
  auto log = LogOf(scenario, robot);
  Tracks tracks =
      log ? RunExperiment(
                ReplayExperiment(scenario, robot.nominal, std::move(log), &recorder, options.stop),
                options, result)
          : RunExperiment(Experiment(scenario, robot, &recorder, options.stop), options, result);
  if (result.outcome == Outcome::kInterrupted) return result;

  LapTimer timer;
  recorder.Close();
  timer.Lap(result.costs.recording_s);
  DropBeforeStart(scenario, tracks);
  WriteTrajectories(tracks, folder.File(""));
  timer.Lap(result.costs.recording_s);
  ScoreTracks(scenario, robot, tracks, result);
  timer.Lap(result.costs.scoring_s);
  folder.Write("metrics.json", MetricsJson(result).dump(2) + "\n");
  timer.Lap(result.costs.recording_s);
  wall.Lap(result.costs.wall_s);
  folder.Write("run.json", RunJson(result, options.command).dump(2) + "\n");
  folder.Publish();
  return result;
}

RunResult ScoreResults(const fs::path& folder, const std::vector<std::string>& overrides) {
  const fs::path resolved = folder / kResolved;
  const auto run = nlohmann::ordered_json::parse(ReadFile(folder / "run.json"), nullptr, false);
  if (!run.is_object() || !fs::exists(resolved)) {
    throw std::invalid_argument("not a result folder: it has no run.json and resolved.yaml");
  }
  const Scenario scenario = ReadScenario(resolved.string(), overrides);
  CheckRecordsWhole(scenario.record);
  const Robot robot = LoadRobot(scenario);
  RunResult result;
  result.expected_exit_code = scenario.expect.exit_code;
  result.scenario = run.value("scenario", "");
  result.seed = scenario.seed;
  result.folder = folder;
  result.failure = run.value("failure", "");
  if (run.value("outcome", "") != "finished") result.outcome = Outcome::kFailed;
  const bool logged = !scenario.log.empty() || !scenario.recording.empty();
  Tracks tracks = ReadTracks(folder / kRecording, logged);
  if (!logged) CheckTruthIsFine(scenario, tracks);
  DropBeforeStart(scenario, tracks);
  ScoreTracks(scenario, robot, tracks, result);
  result.score_overrides = overrides;
  ReplacementFiles files(folder);
  WriteTrajectories(tracks, files.folder());
  files.Write("run.json", WithVerdicts(run, result).dump(2) + "\n");
  files.Write("metrics.json", MetricsJson(result).dump(2) + "\n");
  files.Publish();
  return result;
}

}  // namespace reckon::harness
