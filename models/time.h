#pragma once

#include <cstdint>

namespace reckon::models {

/// A stamp: integer nanoseconds since the run's start. Durations are differences of stamps; they
/// are never summed in floating point.
using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

/// The duration `ns` in seconds.
constexpr double Seconds(TimeNs ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace reckon::models
