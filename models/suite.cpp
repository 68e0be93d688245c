#include "reckon/models/suite.h"

namespace reckon::models {

std::optional<SensorId> Suite::Find(const std::string& name) const {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].name == name) return static_cast<SensorId>(i);
  }
  return std::nullopt;
}

}  // namespace reckon::models
