#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/estimator/estimator.h"
#include "reckon/ground_truth/run_recorder.h"
#include "reckon/ground_truth/track.h"
#include "reckon/harness/costs.h"
#include "reckon/harness/scenario.h"
#include "reckon/harness/truth_history.h"
#include "reckon/models/measurement.h"
#include "reckon/models/suite.h"

namespace reckon::harness {

/// An estimator's belief is no longer finite, or a process behind one failed.
class EstimatorFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the estimators of one run are given, and where what they say goes. The same bench serves a
/// simulation and a replay of its measurements, so that both give the same estimates.
class Bench {
 public:
  /// Makes every estimator of `scenario`. `recorder` may be null, and so may `stop`: when it turns
  /// true, waiting for an external estimator ends with ProcessInterrupted. Throws
  /// std::invalid_argument if an estimator can't be made from this suite.
  Bench(const Scenario& scenario, const models::Suite& nominal, ground_truth::RunRecorder* recorder,
        const std::atomic<bool>* stop = nullptr);

  /// Starts every estimator from its prior.
  void Start(const estimator::Prior& prior);

  /// Hands one measurement to all estimators that may see it. A later arrival than the last ends
  /// the instant: the beliefs held by then are recorded and scored first.
  void Deliver(const models::Measurement& measurement);

  /// Ends the last instant.
  void Finish();

  /// What beliefs are scored against; without it nothing is scored. It must outlive the bench's
  /// work.
  void set_truth(const TruthHistory* truth) { truth_ = truth; }

  /// The estimators' names in the order of the scenario, and what each is by its place there.
  std::vector<std::string> names() const;
  const EstimatorCost& cost(std::size_t i) const { return tested_[i].cost; }
  std::optional<estimator::Estimate> Belief(std::size_t i) const;

  /// What happened so far, by estimator; the bench forgets it.
  std::map<std::string, ground_truth::Track> TakeTracks();

  /// Says what each estimator cost. Recording and scoring while it delivered are taken from what
  /// `costs` holds for the estimators, whose they are not.
  void AddCosts(Costs& costs) const;

 private:
  struct Tested {
    std::string name;
    std::unique_ptr<estimator::Estimator> estimator;
    std::vector<bool> given;  ///< by sensor id
    ground_truth::Track track;
    EstimatorCost cost;
    models::TimeNs recorded_ns = -1;
  };

  void EndInstant();

  std::vector<Tested> tested_;
  ground_truth::RunRecorder* recorder_;
  const TruthHistory* truth_ = nullptr;
  models::TimeNs now_ns_ = 0;
  double recording_s_ = 0.0;
  double scoring_s_ = 0.0;
};

}  // namespace reckon::harness
