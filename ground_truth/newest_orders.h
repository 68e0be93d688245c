#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "reckon/models/measurement.h"

namespace reckon::ground_truth {

/// The places of the newest measurements of each sensor in the order of delivery, found by their
/// valid stamps: a filter may hold a measurement back and use it after later ones have come.
/// Allocates when made, never after.
class NewestOrders {
 public:
  /// A second of the fastest sensor: no filter of ours waits longer for its IMU.
  static constexpr std::size_t kKept = 1024;
  static constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

  explicit NewestOrders(std::size_t sensors) : rings_(sensors) {}

  void Add(models::SensorId sensor, models::TimeNs valid_ns, std::uint64_t order) {
    Ring& ring = rings_.at(sensor);
    ring.entries[ring.added++ % kKept] = {valid_ns, order};
  }

  /// The newest measurement of `sensor` with this stamp; `kUnknown` if none of the last `kKept` is.
  std::uint64_t Find(models::SensorId sensor, models::TimeNs valid_ns) const {
    if (sensor >= rings_.size()) return kUnknown;
    const Ring& ring = rings_[sensor];
    const std::size_t oldest = ring.added > kKept ? ring.added - kKept : 0;
    for (std::size_t i = ring.added; i > oldest; --i) {
      const Entry& entry = ring.entries[(i - 1) % kKept];
      if (entry.valid_ns == valid_ns) return entry.order;
    }
    return kUnknown;
  }

 private:
  struct Entry {
    models::TimeNs valid_ns = 0;
    std::uint64_t order = 0;
  };
  struct Ring {
    std::array<Entry, kKept> entries;
    std::size_t added = 0;
  };
  std::vector<Ring> rings_;
};

}  // namespace reckon::ground_truth
