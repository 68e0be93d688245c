#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reckon/models/suite.h"
#include "reckon/models/time.h"

namespace reckon::ground_truth {

/// A sensor whose measurements are recorded; its place in the plan is its `SensorId`.
struct RecordedSensor {
  models::MountedSensor sensor;       ///< as the nominal robot mounts it
  std::vector<std::string> channels;  ///< a name for each of a sample's, see MostChannels
};

/// What a recording holds. All its streams are made before the run starts.
struct RecordingPlan {
  std::vector<RecordedSensor> sensors;
  std::vector<std::string> estimators;
  std::vector<std::string> wheels;  ///< a name for each wheel of the truth
  std::vector<std::string> feet;    ///< likewise for each foot
  bool truth = true, measurements = true, estimates = true, covariance = true, corrections = true;
  /// The first row at or after each multiple of this is kept; 0: every instant.
  models::TimeNs truth_period_ns = 0;
  models::TimeNs estimate_period_ns = 0;  ///< likewise for estimates
  /// Texts that the file carries: versions, the resolved scenario.
  std::vector<std::pair<std::string, std::string>> attributes;
};

}  // namespace reckon::ground_truth
