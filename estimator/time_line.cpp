#include "reckon/estimator/time_line.h"

namespace reckon::estimator {

using Place = TimeLine::Place;

Place TimeLine::PlaceFor(models::TimeNs t_ns) const {
  Place place = end();
  while (place > begin() && ring_[place - 1].t_ns() > t_ns) --place;
  return place;
}

Place TimeLine::Next(models::SensorId sensor, Place place) const {
  while (place < end() && !ring_[place].Is(sensor)) ++place;
  return place;
}

Place TimeLine::Previous(models::SensorId sensor, Place place) const {
  while (place > begin()) {
    if (ring_[--place].Is(sensor)) return place;
  }
  return end();
}

bool TimeLine::Has(models::SensorId sensor, models::TimeNs t_ns) const {
  for (Place place = PlaceFor(t_ns); place > begin(); --place) {
    const TimedEntry& other = ring_[place - 1];
    if (other.t_ns() < t_ns) return false;
    if (other.Is(sensor)) return true;
  }
  return false;
}

Place TimeLine::Insert(const models::Measurement& measurement) {
  if (ring_.full()) ring_.PopFront();
  const Place place = PlaceFor(measurement.valid_ns);
  ring_.Insert(place, {measurement});
  return place;
}

void TimeLine::DropBefore(Place place) {
  while (begin() < place && !ring_.empty()) ring_.PopFront();
}

}  // namespace reckon::estimator
