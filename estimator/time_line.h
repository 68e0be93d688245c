#pragma once

#include <cstddef>

#include "reckon/estimator/ring.h"
#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// A measurement in a history. What it did was reported once: as a correction, and as a source of
/// the gyro filter.
struct TimedEntry {
  models::Measurement measurement;
  bool heard = false, rate_heard = false;

  models::TimeNs t_ns() const { return measurement.valid_ns; }
  bool Is(models::SensorId sensor) const { return measurement.sensor == sensor; }
};

/// The measurements of the last while in the order of their validity; those of the same stamp in
/// that of their arrival. Allocates only when it is made.
class TimeLine {
 public:
  using Place = Ring<TimedEntry>::Place;

  explicit TimeLine(std::size_t capacity) : ring_(capacity, {}) {}

  Place begin() const { return ring_.begin(); }
  Place end() const { return ring_.end(); }
  TimedEntry& operator[](Place place) { return ring_[place]; }
  const TimedEntry& operator[](Place place) const { return ring_[place]; }

  /// Where a measurement of this stamp would go: behind all that are not later.
  Place PlaceFor(models::TimeNs t_ns) const;

  /// The first entry of `sensor` at or behind `place`, or else the end.
  Place Next(models::SensorId sensor, Place place) const;

  /// The last entry of `sensor` before `place`; the end if there is none.
  Place Previous(models::SensorId sensor, Place place) const;

  /// Whether `sensor` has sent this stamp.
  bool Has(models::SensorId sensor, models::TimeNs t_ns) const;

  /// Puts it into its place, which it returns; if there is no room, the oldest entry goes.
  Place Insert(const models::Measurement& measurement);

  /// Forgets what lies before `place`.
  void DropBefore(Place place);
  void Clear() { ring_.Clear(); }

 private:
  Ring<TimedEntry> ring_;
};

}  // namespace reckon::estimator
