#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/sim/random_stream.h"
#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// Rotary encoders on the joints of the motion window, in its order. A reading of angle q is
///     q_m = floor(c (q (1 + s) + A sin(q + φ) + q₀ + n)) / c,   c = counts_per_rad,
/// unquantised if c is zero; s, φ and q₀ are drawn once an encoder and run. A sample carries the
/// reading at its stamp t and d = (reading at t − reading at t − window)/window, or with a rate
/// filter what one pole makes of that: r⁺ = d + e^(−2π f T) (r − d), T the sample period, r = 0 at
/// first. Readings belong to instants: two windows that touch share one.
///
/// Draws come from "<name>.noise" (channel = encoder, index = physics step), ".scale", ".phase" and
/// ".offset".
class Encoders : public Sensor {
 public:
  /// Throws std::invalid_argument unless the window is a whole number of physics steps and at most
  /// the sample period, and for a negative or non-finite entry.
  Encoders(const std::string& name, models::SensorId id, const EncoderConfig& config,
           std::uint64_t seed, models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::EncoderVector Read(const MotionWindow& motion) const;

  models::SensorId id_;
  SampleClock clock_;
  models::TimeNs window_ns_ = 0;
  double counts_per_rad_, noise_, eccentricity_;
  RandomStream noise_draws_;
  std::array<double, models::kMaxEncoders> gain_{}, phase_{}, offset_{};
  models::EncoderVector begin_;  ///< the reading at the window's start
  double rate_decay_ = 0.0;      ///< of the filter, in one period
  models::EncoderVector rate_;   ///< out of the filter
};

}  // namespace reckon::sim
