#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/report.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"
#include "reckon/models/suite.h"

namespace reckon::ground_truth {

/// Hands out the rows of one stream, first to last; holds one block of them at a time.
template <class Row>
class Cursor {
 public:
  explicit Cursor(std::function<std::optional<Row>()> next) : next_(std::move(next)) {}

  /// The next row; nothing after the last.
  std::optional<Row> Next() { return next_(); }

 private:
  std::function<std::optional<Row>()> next_;
};

/// A measurement that an estimator refused as a whole.
struct RefusedMeasurement {
  models::TimeNs valid_ns = 0, arrival_ns = 0;
  models::SensorId sensor = 0;
  estimator::Refusal reason = estimator::Refusal::kNone;
};

/// Reads what RunRecorder wrote, also while it is written and after its writer was killed.
/// Everything comes back bit by bit. A stream that the plan left out gives no rows. A row with a
/// number that stands for nothing (the file is damaged) throws RecordingError.
class RecordingReader {
 public:
  /// Throws RecordingError if the file is missing or no recording.
  explicit RecordingReader(const std::filesystem::path& path);
  ~RecordingReader();
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;

  /// Whether its writer closed it; false after a kill, or while the run goes on.
  bool closed() const;

  /// The text attribute `name` of the file; nothing if there is none.
  std::optional<std::string> Attribute(const std::string& name) const;

  /// The sensors as they were mounted on the nominal robot, by id, and the estimators in the order
  /// of the plan.
  const std::vector<models::MountedSensor>& sensors() const;
  const std::vector<std::string>& estimators() const;

  Cursor<Truth> ReadTruth() const;

  /// The measurements of all sensors in the exact order in which estimators were given them. Of a
  /// recording that was cut off: those up to the first that was lost.
  Cursor<models::Measurement> ReadMeasurements() const;

  Cursor<estimator::Estimate> ReadEstimates(std::size_t estimator) const;
  Cursor<estimator::Correction> ReadCorrections(std::size_t estimator) const;
  Cursor<RefusedMeasurement> ReadRefusals(std::size_t estimator) const;

  /// What the estimator started from; nothing if it never did.
  std::optional<estimator::Prior> ReadPrior(std::size_t estimator) const;

 private:
  class Impl;
  std::shared_ptr<const Impl> impl_;  // cursors share it: they may outlive the reader
};

}  // namespace reckon::ground_truth
