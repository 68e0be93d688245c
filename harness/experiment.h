#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "reckon/ground_truth/run_recorder.h"
#include "reckon/harness/bench.h"
#include "reckon/harness/costs.h"
#include "reckon/harness/delivery_queue.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/scenario.h"
#include "reckon/harness/truth_history.h"
#include "reckon/sim/sensor_suite.h"
#include "reckon/sim/world.h"

namespace reckon::harness {

/// One run in memory: world → sensors → delivery → estimators, and truth beside them. Nothing is
/// shared with other experiments. `recorder` may be null; then only the tracks are kept.
class Experiment {
 public:
  struct Hooks {
    std::function<void(double fraction, double real_time_factor)> progress;
    bool poison_truth = false;  ///< truth turns to NaN once the priors are drawn
  };

  /// `stop` (it may be null) ends the run when it turns true. Throws std::invalid_argument if the
  /// robot, the world or an estimator can't be built.
  Experiment(const Scenario& scenario, const Robot& robot, ground_truth::RunRecorder* recorder,
             const std::atomic<bool>* stop = nullptr);

  /// Runs to the end; false if it was stopped. Throws sim::WorldFailure, EstimatorFailure,
  /// ProcessFailure, ProcessInterrupted (stopped as well), or what the recorder throws.
  bool Run(const Hooks& hooks);

  /// What happened to each estimator; empty after the first call.
  std::map<std::string, ground_truth::Track> TakeTracks() { return bench_.TakeTracks(); }
  const Costs& costs() const { return costs_; }

 private:
  /// One physics step; `first` draws the priors.
  void Step(bool first, bool poison);
  ground_truth::Truth TruthNow() const;

  const Scenario& scenario_;
  ground_truth::RunRecorder* recorder_;
  const std::atomic<bool>* stop_;
  Costs costs_;
  LapTimer timer_;
  sim::World world_;
  sim::SensorSuite sensors_;
  TruthHistory truth_;
  DeliveryQueue queue_;
  Bench bench_;
  std::vector<models::Measurement> sent_;
};

}  // namespace reckon::harness
