#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/report.h"
#include "reckon/ground_truth/recording_plan.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"

namespace reckon::ground_truth {

/// A recording can't be written or read: the message names the file and the system's reason.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes everything that happens in a run to one HDF5 file, at full rate:
///     /truth                                    one row an instant
///     /measurements/<sensor>                    as sent; `order` counts over all sensors
///     /estimates/<estimator>/state              and /covariance, row by row its upper triangle
///     /estimates/<estimator>/corrections        innovations as they were before the gate
///     /estimates/<estimator>/refusals           measurements refused as a whole
///     /estimates/<estimator>/prior              and /prior_covariance, one row
/// The file can be read while it is written; what was flushed survives a kill. Rows are flushed in
/// whole chunks (`kChunkBytes`, at most `kChunkRows`). Adding does not allocate. The same rows give
/// the same bytes. Estimators are addressed by their place in the plan.
class RunRecorder {
 public:
  static constexpr std::size_t kChunkBytes = 256 * 1024;
  static constexpr std::size_t kChunkRows = 1024;

  /// Makes the file with all its streams; an existing one is replaced. Throws RecordingError.
  RunRecorder(const std::filesystem::path& path, RecordingPlan plan);
  ~RunRecorder();  ///< closes without a word; call Close() to hear of errors
  RunRecorder(RunRecorder&&) noexcept;
  RunRecorder& operator=(RunRecorder&&) noexcept;

  /// All of these throw RecordingError when the disk is full (the file is then of no more use).
  void Add(const Truth& truth);
  /// Call in the order in which estimators are given the measurements: that order is replayed.
  void Add(const models::Measurement& measurement);
  void Add(std::size_t estimator, const estimator::Estimate& estimate);
  /// `measurement` must be the one added last; the corrections may be of earlier ones, which are
  /// found by sensor and valid stamp among the newest of each sensor.
  void Add(std::size_t estimator, const models::Measurement& measurement,
           const estimator::Report& report);
  void AddPrior(std::size_t estimator, const estimator::Prior& prior);

  /// Writes what is left and closes.
  void Close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reckon::ground_truth
