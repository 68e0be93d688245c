#include "reckon/sim/load_noise.h"

#include <algorithm>
#include <cmath>

#include "reckon/sim/sample_clock.h"

namespace reckon::sim {

LoadNoise::LoadNoise(const std::string& sensor, const std::string& unit, const LoadErrors& errors,
                     std::uint64_t seed)
    : errors_(errors),
      noise_(seed, sensor + ".noise"),
      scale_(seed, sensor + ".scale"),
      offset_(seed, sensor + ".offset") {
  RequireNotNegative(sensor, "noise_" + unit, errors.noise);
  RequireNotNegative(sensor, "offset_" + unit, errors.offset);
  RequireNotNegative(sensor, "scale", errors.scale);
  RequireNotNegative(sensor, "range_" + unit, errors.range);
  RequireNotNegative(sensor, "resolution_" + unit, errors.resolution);
}

double LoadNoise::Read(double load, std::uint32_t channel, std::uint64_t sample) const {
  double y = load;
  if (errors_.scale > 0.0) y *= 1.0 + errors_.scale * scale_.Normal(channel, 0);
  if (errors_.offset > 0.0) y += errors_.offset * offset_.Normal(channel, 0);
  if (errors_.noise > 0.0) y += errors_.noise * noise_.Normal(channel, sample);
  if (errors_.range > 0.0) y = std::clamp(y, -errors_.range, errors_.range);
  if (errors_.resolution > 0.0) y = errors_.resolution * std::round(y / errors_.resolution);
  return y;
}

}  // namespace reckon::sim
