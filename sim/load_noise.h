#pragma once

#include <cstdint>
#include <string>

#include "reckon/sim/random_stream.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// What a torque or force sensor with these errors reads of a load x, channel by channel:
///     y = Q(sat((1 + s) x + b + n)),   s, b drawn once a channel and run,   n white, a sample.
/// Draws come from "<name>.noise" (index = sample), ".scale" and ".offset".
class LoadNoise {
 public:
  /// Throws std::invalid_argument for a negative or non-finite entry, named by its key with
  /// `unit` ("n", "n_m").
  LoadNoise(const std::string& sensor, const std::string& unit, const LoadErrors& errors,
            std::uint64_t seed);

  /// Does not allocate.
  double Read(double load, std::uint32_t channel, std::uint64_t sample) const;

 private:
  LoadErrors errors_;
  RandomStream noise_, scale_, offset_;
};

}  // namespace reckon::sim
