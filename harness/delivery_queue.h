#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "reckon/models/measurement.h"

namespace reckon::harness {

/// Messages on their way: they leave in order of arrival, and those that arrive at the same instant
/// in the order in which they were sent.
class DeliveryQueue {
 public:
  void Send(const models::Measurement& measurement) {
    waiting_.push({measurement, next_number_++});
  }

  /// Whether a message has arrived by `now_ns`.
  bool HasArrived(models::TimeNs now_ns) const {
    return !waiting_.empty() && waiting_.top().measurement.arrival_ns <= now_ns;
  }

  /// Takes the next message; there must be one.
  models::Measurement Take() {
    models::Measurement measurement = waiting_.top().measurement;
    waiting_.pop();
    return measurement;
  }

 private:
  struct Message {
    models::Measurement measurement;
    std::uint64_t number;
    bool operator<(const Message& other) const {  // a priority queue puts its largest first
      const auto mine = measurement.arrival_ns;
      const auto theirs = other.measurement.arrival_ns;
      return mine != theirs ? mine > theirs : number > other.number;
    }
  };

  std::priority_queue<Message> waiting_;
  std::uint64_t next_number_ = 0;
};

}  // namespace reckon::harness
