#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "reckon/harness/csv_table.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/measurement_log.h"

namespace reckon::harness {

class CsvStream;
class CsvTruth;

/// A log as `docs/log_format.md` has it: a folder with `log.yaml` and a CSV file a stream. Holds
/// one row of each. Time counts from the whole second in which the first row of all falls; what
/// came before the start (the `start` section's is the first IMU sample's beginning, else the first
/// row of truth) is left out.
class CsvLog final : public MeasurementLog {
 public:
  /// Throws InputError for a file that can't be read or lacks a column, and a log without rows.
  CsvLog(const LoadedLog& log, const models::Suite& suite);
  ~CsvLog() override;

  /// From the `start` section as it is, or drawn about the first truth as in a simulation (biases
  /// that it does not tell: about zero). Throws
  /// InputError if the log has neither.
  estimator::Prior Start(const InitialConfig& initial, std::uint64_t seed) override;

  /// Throw InputError for a row that is wrong.
  std::optional<models::Measurement> Next() override;
  std::optional<ground_truth::Truth> NextTruth() override;

 private:
  const LoadedLog log_;
  std::vector<std::unique_ptr<CsvStream>> streams_;
  std::unique_ptr<CsvTruth> truth_;
  models::TimeNs epoch_ns_ = 0, begin_ns_ = 0;  ///< in the files' own time
};

}  // namespace reckon::harness
