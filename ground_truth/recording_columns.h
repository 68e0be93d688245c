#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/ground_truth/column.h"
#include "reckon/ground_truth/recording_plan.h"

namespace reckon::ground_truth {

/// The layout of each stream of a recording, column by column; the encoders in `record_codec.h`
/// follow the same order.
Columns TruthColumns(const std::vector<std::string>& wheels, const std::vector<std::string>& feet);
Columns MeasurementColumns(const RecordedSensor& sensor);
Columns EstimateColumns(const std::vector<std::string>& feet);
Columns CorrectionColumns();
Columns RefusalColumns();
Columns PriorColumns();

/// The names of enumerators by their recorded number.
std::span<const std::string_view> SensorKindNames();
std::span<const std::string_view> ErrorFormNames();
std::span<const std::string_view> DecisionNames();
std::span<const std::string_view> RefusalNames();

/// The names of the 15 error coordinates, in the order of the covariance.
const std::vector<std::string>& ErrorNames();

/// What the numbers of a recording mean, for its attributes: (name, text).
std::span<const std::pair<std::string_view, std::string_view>> Conventions();

}  // namespace reckon::ground_truth
