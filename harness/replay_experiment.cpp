#include "reckon/harness/replay_experiment.h"

#include <algorithm>

namespace reckon::harness {
namespace {

/// Rows of truth kept while estimates are paired with them.
constexpr std::size_t kTruthRows = 8192;
/// Measurements between two looks at the stop flag.
constexpr std::int64_t kPerCheck = 256;

}  // namespace

ReplayExperiment::ReplayExperiment(const Scenario& scenario, const models::Suite& nominal,
                                   std::unique_ptr<MeasurementLog> log,
                                   ground_truth::RunRecorder* recorder,
                                   const std::atomic<bool>* stop)
    : scenario_(scenario),
      log_(std::move(log)),
      recorder_(recorder),
      stop_(stop),
      truth_(kTruthRows),
      bench_(scenario, nominal, recorder, stop) {
  truth_.AllowHoles();
  bench_.set_truth(&truth_);
  timer_.Lap(costs_.setup_s);
}

void ReplayExperiment::LearnTruth(models::TimeNs t_ns) {
  while (has_truth_ && truth_ns_ < t_ns) {
    const auto truth = log_->NextTruth();
    has_truth_ = truth.has_value();
    if (!truth) return;
    truth_ns_ = truth->t_ns;
    truth_.Add(*truth);
    if (recorder_ != nullptr) recorder_->Add(*truth);
  }
}

bool ReplayExperiment::Run(const Experiment::Hooks& /*hooks*/) {
  bench_.Start(log_->Start(scenario_.initial, scenario_.seed));
  timer_.Lap(costs_.setup_s);
  models::TimeNs now_ns = 0;
  for (std::int64_t k = 0;; ++k) {
    const auto measurement = log_->Next();
    if (!measurement) break;
    timer_.Lap(costs_.sensors_s);
    LearnTruth(measurement->arrival_ns);
    timer_.Lap(costs_.recording_s);
    now_ns = std::max(now_ns, measurement->arrival_ns);
    bench_.Deliver(*measurement);
    timer_.Lap(costs_.estimators_s);
    if (k % kPerCheck == 0 && stop_ != nullptr && *stop_) return false;
  }
  bench_.Finish();
  timer_.Lap(costs_.estimators_s);
  costs_.simulated_s = models::Seconds(now_ns);
  bench_.AddCosts(costs_);
  return true;
}

}  // namespace reckon::harness
