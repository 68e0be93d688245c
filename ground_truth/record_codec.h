#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/report.h"
#include "reckon/ground_truth/recording_reader.h"
#include "reckon/ground_truth/table_reader.h"
#include "reckon/ground_truth/table_writer.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"
#include "reckon/models/suite.h"

namespace reckon::ground_truth {

// One row of each stream, written and read in the order of `recording_columns.h`. Everything that
// is written comes back bit by bit. A number that stands for something else (an entry of a list of
// names, a size) is checked: if it can't be, decoding throws RecordingError, which names the column
// (the reader adds file and row).

void Encode(const Truth& truth, RowEncoder& row);
void Encode(const models::Measurement& measurement, std::uint64_t order, RowEncoder& row);
void Encode(const estimator::Estimate& estimate, std::int64_t covariance_row, int feet,
            RowEncoder& row);
void Encode(const estimator::Correction& correction, std::uint64_t order, RowEncoder& row);
void Encode(const models::Measurement& measurement, estimator::Refusal reason, std::uint64_t order,
            RowEncoder& row);
void Encode(const estimator::Prior& prior, RowEncoder& row);

Truth DecodeTruth(RowDecoder& row, int wheels, int feet);
/// The sample's kind and its number of encoders or feet are the sensor's.
models::Measurement DecodeMeasurement(RowDecoder& row, models::SensorId sensor,
                                      models::SensorKind kind, int channels, std::uint64_t* order);
/// Without the covariance, which is in a table of its own.
estimator::Estimate DecodeEstimate(RowDecoder& row, int feet, std::int64_t* covariance_row);
/// `sensors` is how many the recording knows.
estimator::Correction DecodeCorrection(RowDecoder& row, std::size_t sensors);
RefusedMeasurement DecodeRefusal(RowDecoder& row, std::size_t sensors);
estimator::Prior DecodePrior(RowDecoder& row);

}  // namespace reckon::ground_truth
