#pragma once

#include <cstdint>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/report.h"
#include "reckon/ground_truth/table_reader.h"
#include "reckon/ground_truth/table_writer.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"
#include "reckon/models/suite.h"

namespace reckon::ground_truth {

// One row of each stream, written and read in the order of `recording_columns.h`. Everything that
// is written comes back bit by bit.

void Encode(const Truth& truth, RowEncoder& row);
void Encode(const models::Measurement& measurement, std::uint64_t order, RowEncoder& row);
void Encode(const estimator::Estimate& estimate, std::int64_t covariance_row, RowEncoder& row);
void Encode(const estimator::Correction& correction, std::uint64_t order, RowEncoder& row);
void Encode(const models::Measurement& measurement, estimator::Refusal reason, std::uint64_t order,
            RowEncoder& row);
void Encode(const estimator::Prior& prior, RowEncoder& row);

Truth DecodeTruth(RowDecoder& row, int wheels);
/// The sample's kind and its number of encoders are the sensor's.
models::Measurement DecodeMeasurement(RowDecoder& row, models::SensorId sensor,
                                      models::SensorKind kind, int channels, std::uint64_t* order);
/// Without the covariance, which is in a table of its own.
estimator::Estimate DecodeEstimate(RowDecoder& row, std::int64_t* covariance_row);
estimator::Correction DecodeCorrection(RowDecoder& row);
estimator::Prior DecodePrior(RowDecoder& row);

}  // namespace reckon::ground_truth
