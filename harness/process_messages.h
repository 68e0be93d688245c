#pragma once

#include <string>
#include <string_view>

#include "reckon/estimator/prior.h"
#include "reckon/estimator/setup.h"
#include "reckon/models/measurement.h"

namespace reckon::harness {

inline constexpr int kProcessSchema = 1;

/// What an external estimator reads (docs/process_estimator.md): one JSON object and a newline
/// each. Doubles survive the round trip, a non-finite one is null. The same arguments give the same
/// bytes.
std::string HelloMessage(std::string_view robot, const estimator::Setup& setup);
std::string StartMessage(const estimator::Prior& prior);
std::string MeasurementMessage(const models::Measurement& measurement);

}  // namespace reckon::harness
