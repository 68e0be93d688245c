#pragma once

#include <array>
#include <cstddef>

#include "reckon/estimator/report.h"
#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// A few measurements that wait until the IMU reaches their time of validity: no more than one
/// report can show. They leave in order of validity.
class HoldingBuffer {
 public:
  /// Keeps `measurement`; false if there is no room.
  bool Hold(const models::Measurement& measurement) {
    if (size_ == held_.size()) return false;
    std::size_t i = size_++;
    for (; i > 0 && held_[i - 1].valid_ns > measurement.valid_ns; --i) held_[i] = held_[i - 1];
    held_[i] = measurement;
    return true;
  }

  bool HasUntil(models::TimeNs t_ns) const { return size_ > 0 && held_[0].valid_ns <= t_ns; }

  models::TimeNs first_ns() const { return held_[0].valid_ns; }

  /// The earliest; there must be one.
  models::Measurement Take() {
    models::Measurement first = held_[0];
    for (std::size_t i = 1; i < size_; ++i) held_[i - 1] = held_[i];
    --size_;
    return first;
  }

  void Clear() { size_ = 0; }

 private:
  std::array<models::Measurement, kMaxCorrections> held_;
  std::size_t size_ = 0;
};

}  // namespace reckon::estimator
