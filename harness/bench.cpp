#include "reckon/harness/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reckon/estimator/registry.h"
#include "reckon/harness/beliefs.h"
#include "reckon/harness/process_estimator.h"

namespace reckon::harness {
namespace {

bool IsFinite(const estimator::Estimate& estimate) {
  return estimate.X_WB.R.allFinite() && estimate.X_WB.p.allFinite() && estimate.v_WB.allFinite() &&
         estimate.gyro_bias_rad_s.allFinite() && estimate.accel_bias_m_s2.allFinite() &&
         estimate.covariance.allFinite();
}

std::unique_ptr<estimator::Estimator> MakeEstimator(const std::string& name,
                                                    const EstimatorConfig& config,
                                                    const estimator::Setup& setup,
                                                    const std::string& robot,
                                                    const std::atomic<bool>* stop) {
  if (config.type == "process") {
    return std::make_unique<ProcessEstimator>(
        ProcessOptions{name, config.command, config.working_folder, config.timeout_s, robot, stop},
        setup);
  }
  const estimator::RegistryEntry* entry = estimator::FindEstimator(config.type);
  if (entry == nullptr) {
    throw std::invalid_argument(fmt::format("estimator '{}': no type '{}'", name, config.type));
  }
  return entry->make(setup);
}

/// Which sensors an estimator is given, by id.
std::vector<bool> Given(const EstimatorConfig& config, const models::Suite& suite) {
  std::vector<bool> given(suite.sensors.size(), config.sensors.empty());
  for (const auto& name : config.sensors) {
    if (const auto id = suite.Find(name)) given[*id] = true;
  }
  return given;
}

}  // namespace

Bench::Bench(const Scenario& scenario, const models::Suite& nominal,
             ground_truth::RunRecorder* recorder, const std::atomic<bool>* stop)
    : recorder_(recorder) {
  for (const auto& [name, config] : scenario.estimators) {
    const estimator::Setup setup =
        MakeSetup(config, scenario.initial, nominal, scenario.world.gravity_m_s2);
    Tested tested;
    tested.name = name;
    tested.estimator = MakeEstimator(name, config, setup, scenario.robot, stop);
    tested.given = Given(config, nominal);
    tested_.push_back(std::move(tested));
  }
}

std::vector<std::string> Bench::names() const {
  std::vector<std::string> names;
  for (const Tested& tested : tested_) names.push_back(tested.name);
  return names;
}

std::optional<estimator::Estimate> Bench::Belief(std::size_t i) const {
  return tested_[i].estimator->Belief();
}

std::map<std::string, ground_truth::Track> Bench::TakeTracks() {
  std::map<std::string, ground_truth::Track> tracks;
  for (Tested& tested : tested_) tracks[tested.name] = std::exchange(tested.track, {});
  return tracks;
}

void Bench::Start(const estimator::Prior& prior) {
  for (std::size_t i = 0; i < tested_.size(); ++i) {
    tested_[i].estimator->Start(prior);
    if (recorder_ != nullptr) recorder_->AddPrior(i, prior);
  }
}

void Bench::Deliver(const models::Measurement& measurement) {
  if (measurement.arrival_ns > now_ns_) EndInstant();
  now_ns_ = measurement.arrival_ns;
  LapTimer timer;
  if (recorder_ != nullptr) recorder_->Add(measurement);
  timer.Lap(recording_s_);
  const bool imu = std::holds_alternative<models::ImuSample>(measurement.sample);
  for (std::size_t i = 0; i < tested_.size(); ++i) {
    Tested& tested = tested_[i];
    if (!tested.given[measurement.sensor]) continue;
    CallCost& cost = imu ? tested.cost.propagations : tested.cost.corrections;
    const estimator::Report report = tested.estimator->Process(measurement);
    timer.Lap(cost.total_s);
    ++cost.calls;
    tested.track.Add(measurement, report);
    if (recorder_ != nullptr) recorder_->Add(i, measurement, report);
    timer.Lap(recording_s_);
  }
}

void Bench::EndInstant() {
  LapTimer timer;
  for (std::size_t i = 0; i < tested_.size(); ++i) {
    Tested& tested = tested_[i];
    const auto belief = tested.estimator->Belief();
    double estimating_s = 0.0;  // stays the estimators': it is neither recording nor scoring
    timer.Lap(estimating_s);
    if (!belief || belief->t_ns <= tested.recorded_ns) continue;
    if (!IsFinite(*belief)) {
      throw EstimatorFailure(fmt::format("estimator '{}' is no longer finite at t = {:.3f} s",
                                         tested.name, models::Seconds(belief->t_ns)));
    }
    tested.recorded_ns = belief->t_ns;
    if (recorder_ != nullptr) recorder_->Add(i, *belief);
    timer.Lap(recording_s_);
    if (truth_ == nullptr) continue;
    truth_->Pair(*belief, tested.track);
    timer.Lap(scoring_s_);
  }
}

void Bench::Finish() { EndInstant(); }

void Bench::AddCosts(Costs& costs) const {
  for (const Tested& tested : tested_) costs.estimators[tested.name] = tested.cost;
  costs.recording_s += recording_s_;
  costs.scoring_s += scoring_s_;
  costs.estimators_s -= recording_s_ + scoring_s_;
}

}  // namespace reckon::harness
