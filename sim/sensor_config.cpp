#include "reckon/sim/sensor_config.h"

#include <array>

namespace reckon::sim {

models::SensorKind KindOf(const SensorErrors& errors) {
  using Kind = models::SensorKind;
  constexpr std::array kKinds{Kind::kImu,      Kind::kEncoders, Kind::kBodyVelocity,
                              Kind::kDepth,    Kind::kPose,     Kind::kBodyVelocity,
                              Kind::kContacts, Kind::kTorques,  Kind::kFootForces};
  static_assert(kKinds.size() == std::variant_size_v<SensorErrors>);
  return kKinds[errors.index()];
}

}  // namespace reckon::sim
