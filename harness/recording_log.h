#pragma once

#include <filesystem>

#include "reckon/ground_truth/recording_reader.h"
#include "reckon/harness/measurement_log.h"

namespace reckon::harness {

/// A recording of ours as a log: the same measurements, priors and truth.
class RecordingLog final : public MeasurementLog {
 public:
  /// Throws RecordingError, and std::invalid_argument if it holds no prior to start from.
  explicit RecordingLog(const std::filesystem::path& path);

  estimator::Prior Start(const InitialConfig& initial, std::uint64_t seed) override;
  std::optional<models::Measurement> Next() override { return measurements_.Next(); }
  std::optional<ground_truth::Truth> NextTruth() override { return truth_.Next(); }

 private:
  ground_truth::RecordingReader reader_;
  ground_truth::Cursor<models::Measurement> measurements_;
  ground_truth::Cursor<ground_truth::Truth> truth_;
  estimator::Prior prior_;
};

}  // namespace reckon::harness
