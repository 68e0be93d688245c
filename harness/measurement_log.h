#pragma once

#include <cstdint>
#include <optional>

#include "reckon/estimator/prior.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/harness/scenario.h"
#include "reckon/models/measurement.h"

namespace reckon::harness {

/// What a robot's sensors said once, in the order in which it arrived, and what is known of the
/// truth beside it.
class MeasurementLog {
 public:
  virtual ~MeasurementLog() = default;

  /// Where all estimators start.
  virtual estimator::Prior Start(const InitialConfig& initial, std::uint64_t seed) = 0;

  /// The next measurement, by arrival, and the next row of truth, by time; nothing after the last.
  virtual std::optional<models::Measurement> Next() = 0;
  virtual std::optional<ground_truth::Truth> NextTruth() = 0;
};

}  // namespace reckon::harness
