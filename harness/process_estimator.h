#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/estimator/estimator.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/setup.h"
#include "reckon/harness/child_process.h"

namespace reckon::harness {

/// An external estimator failed: it ended, fell silent, or answered with what can't be used. The
/// message names the estimator, what was expected, what came, and its last lines of standard error.
class ProcessFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The stop flag turned true while an external estimator was waited for: it is gone, and its answer
/// with it.
class ProcessInterrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ProcessOptions {
  std::string name;                  ///< of the estimator in the scenario
  std::vector<std::string> command;  ///< the program and its arguments
  std::filesystem::path working_folder;
  double timeout_s = 10.0;  ///< the longest wait for one answer
  std::string robot;
  const std::atomic<bool>* stop = nullptr;  ///< ends a wait when it turns true; may be null
};

/// Anyone's estimator: a program that reads measurements and writes beliefs, one line of JSON each
/// (docs/process_estimator.md). It is told what a built-in estimator is told, and truth never.
///
/// The program runs from construction to destruction. Unlike a built-in estimator, `Process`
/// allocates, and both it and `Start` throw ProcessFailure, or ProcessInterrupted; after that the
/// program is gone and every call throws.
class ProcessEstimator final : public estimator::Estimator {
 public:
  /// Starts the program. Throws ProcessStartError (an std::invalid_argument) if it can't, or if the
  /// timeout is not in (0, 86400] s.
  ProcessEstimator(ProcessOptions options, const estimator::Setup& setup);
  ~ProcessEstimator() override;

  void Start(const estimator::Prior& prior) override;
  estimator::Report Process(const models::Measurement& measurement) override;
  std::optional<estimator::Estimate> Belief() const override { return belief_; }

  const ChildProcess& child() const { return *child_; }

 private:
  std::string Ask(std::string_view text, std::string_view question);
  [[noreturn]] void Fail(std::string_view question, std::string_view what);

  ProcessOptions options_;
  std::size_t sensors_;
  std::string unsent_hello_;  // goes out with the first `start`
  std::unique_ptr<ChildProcess> child_;
  std::string failure_;  // why the program is gone; empty while it runs
  std::optional<estimator::Estimate> belief_;
  estimator::ErrorForm form_ = estimator::ErrorForm::kRightInvariant;
  models::TimeNs earliest_ns_ = 0, latest_ns_ = 0;  // of the next belief
  std::size_t answered_ = 0;                        // measurements since the start
};

}  // namespace reckon::harness
