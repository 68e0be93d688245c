#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "reckon/models/time.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// Throws std::invalid_argument: "sensor '<sensor>': <field> is <found>, expected <allowed>".
[[noreturn]] void RefuseField(std::string_view sensor, std::string_view field, double found,
                              std::string_view allowed);

/// Refuses what is negative or not finite.
void RequireNotNegative(std::string_view sensor, std::string_view field, double value);

/// When a sensor samples: at period, 2 period, … The period is a whole number of physics steps, so
/// that every sample falls on one.
class SampleClock {
 public:
  /// Throws std::invalid_argument unless the rate is an integer fraction of the physics rate and
  /// the latency at least zero.
  SampleClock(std::string_view sensor, const Timing& timing, models::TimeNs physics_step_ns);

  models::TimeNs step_ns() const { return step_ns_; }
  models::TimeNs period_ns() const { return period_ns_; }

  /// What a sample of instant `t_ns` claims as its time of validity, and when it arrives.
  models::TimeNs Valid(models::TimeNs t_ns) const { return t_ns + stamp_error_ns_; }
  models::TimeNs Arrival(models::TimeNs t_ns) const {
    return std::max(t_ns, Valid(t_ns)) + latency_ns_;
  }

  bool IsSample(models::TimeNs t_ns) const { return t_ns == next_ns_; }

  /// The next sample's number, from 0 on: the sample stamped (index + 1) · period.
  std::uint64_t index() const { return index_; }
  models::TimeNs next_ns() const { return next_ns_; }

  /// To be called when a sample is taken.
  void Advance() {
    ++index_;
    next_ns_ += period_ns_;
  }

 private:
  models::TimeNs step_ns_, period_ns_, next_ns_;
  models::TimeNs latency_ns_ = 0, stamp_error_ns_ = 0;
  std::uint64_t index_ = 0;
};

}  // namespace reckon::sim
