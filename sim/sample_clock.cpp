#include "reckon/sim/sample_clock.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace reckon::sim {
namespace {

/// Messages wait in memory until they arrive; a day is beyond any sensor.
constexpr double kLongestLatencyS = 86400.0;

models::TimeNs PeriodNs(std::string_view sensor, double rate_hz, models::TimeNs step_ns) {
  const double physics_hz = 1.0 / models::Seconds(step_ns);
  const double ratio = physics_hz / rate_hz;
  // The tolerance admits rates whose decimal text can't be exact, such as 33.333333 of 100 Hz.
  const bool divides = rate_hz > 0.0 && ratio < 1e9 && std::round(ratio) >= 1.0 &&
                       std::abs(ratio - std::round(ratio)) <= 1e-6 * ratio;
  if (!divides) {
    std::ostringstream allowed;
    allowed << "an integer fraction of the physics rate of " << physics_hz << " Hz";
    RefuseField(sensor, "rate_hz", rate_hz, allowed.str());
  }
  return std::llround(ratio) * step_ns;
}

}  // namespace

void RefuseField(std::string_view sensor, std::string_view field, double found,
                 std::string_view allowed) {
  std::ostringstream text;
  text << "sensor '" << sensor << "': " << field << " is " << found << ", expected " << allowed;
  throw std::invalid_argument(text.str());
}

void RequireNotNegative(std::string_view sensor, std::string_view field, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    RefuseField(sensor, field, value, "a finite number of at least 0");
  }
}

SampleClock::SampleClock(std::string_view sensor, const Timing& timing,
                         models::TimeNs physics_step_ns)
    : step_ns_(physics_step_ns),
      period_ns_(PeriodNs(sensor, timing.rate_hz, physics_step_ns)),
      next_ns_(period_ns_) {
  RequireNotNegative(sensor, "latency_s", timing.latency_s);
  if (timing.latency_s > kLongestLatencyS) {
    RefuseField(sensor, "latency_s", timing.latency_s, "at most 86400");
  }
  if (!(std::abs(timing.stamp_error_s) <= kLongestLatencyS)) {
    RefuseField(sensor, "stamp_error_s", timing.stamp_error_s, "within ±86400");
  }
  latency_ns_ = std::llround(timing.latency_s * 1e9);
  stamp_error_ns_ = std::llround(timing.stamp_error_s * 1e9);
}

}  // namespace reckon::sim
