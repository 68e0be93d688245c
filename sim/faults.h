#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/models/measurement.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// The faults of one sensor: what a schedule does to its stream of messages.
///
/// A fault acts on samples whose time of validity, before any jitter, lies in [at_s, at_s + for_s).
/// Faults that overlap act in the order of the schedule. Draws come from the stream "fault.<place
/// in the schedule>.<sensor>". Does not allocate after construction.
class FaultInjector {
 public:
  /// Takes the entries of `schedule` that name `sensor`. Throws std::invalid_argument for a start,
  /// duration or magnitude that no fault of its kind can have; that the sensor has the channels is
  /// the caller's to check.
  FaultInjector(std::string_view sensor, std::span<const FaultConfig> schedule, std::uint64_t seed);

  /// Passes the sensor's next message through all of its faults; false: it is never sent.
  ///
  /// Misreported times of validity stay strictly increasing: one that would not is set 1 ns after
  /// the stamp before it, also after the jitter's end, until the true stamps have caught up. No
  /// message arrives before the validity that it claims: a receiver would take it for one from the
  /// future.
  /// Arrivals may change their order (a delay that ends): the receiver sorts by arrival.
  bool Apply(models::Measurement& message);

 private:
  struct Fault {
    FaultKind kind;
    models::TimeNs begin_ns, end_ns;
    double magnitude;
    FaultChannels channels;
    RandomStream draws;
    std::optional<models::Sample> last_good;  ///< stuck: what is repeated
  };

  bool ApplyOne(Fault& fault, models::Measurement& message) const;

  std::vector<Fault> faults_;
  std::uint64_t index_ = 0;  ///< of the sensor's messages, sent or not
  bool jitters_ = false;
  std::optional<models::TimeNs> last_valid_ns_;
};

/// The name of a kind of fault as scenarios write it: "dropout", "bias_step", …
std::string_view FaultKindName(FaultKind kind);

/// The name of channels as scenarios write it: "all", "gyro", …
std::string_view FaultChannelsName(FaultChannels channels);

}  // namespace reckon::sim
