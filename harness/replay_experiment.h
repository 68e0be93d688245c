#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "reckon/ground_truth/run_recorder.h"
#include "reckon/harness/bench.h"
#include "reckon/harness/costs.h"
#include "reckon/harness/experiment.h"
#include "reckon/harness/measurement_log.h"
#include "reckon/harness/scenario.h"
#include "reckon/harness/truth_history.h"

namespace reckon::harness {

/// A run whose measurements come from a log in place of the simulator: log → estimators, and truth
/// beside them as far as it is known. `recorder` may be null.
class ReplayExperiment {
 public:
  /// Throws std::invalid_argument if an estimator can't be built.
  ReplayExperiment(const Scenario& scenario, const models::Suite& nominal,
                   std::unique_ptr<MeasurementLog> log, ground_truth::RunRecorder* recorder,
                   const std::atomic<bool>* stop = nullptr);

  /// As Experiment::Run; throws what the log throws beside that.
  bool Run(const Experiment::Hooks& hooks);

  std::map<std::string, ground_truth::Track> TakeTracks() { return bench_.TakeTracks(); }
  const Costs& costs() const { return costs_; }

 private:
  /// Takes truth up to the first row that is not before `t_ns`.
  void LearnTruth(models::TimeNs t_ns);

  const Scenario& scenario_;
  std::unique_ptr<MeasurementLog> log_;
  ground_truth::RunRecorder* recorder_;
  const std::atomic<bool>* stop_;
  Costs costs_;
  LapTimer timer_;
  TruthHistory truth_;
  models::TimeNs truth_ns_ = -1;
  bool has_truth_ = true;
  Bench bench_;
};

}  // namespace reckon::harness
