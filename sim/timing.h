#pragma once

namespace reckon::sim {

/// When a sensor samples and how long its message travels.
struct Timing {
  double rate_hz = 200.0;  ///< an integer fraction of the physics rate
  double latency_s = 0.0;  ///< from validity to arrival
  /// The sensor's clock is off: a sample of instant t claims to be valid at t + this. It arrives
  /// `latency_s` after both.
  double stamp_error_s = 0.0;
};

}  // namespace reckon::sim
