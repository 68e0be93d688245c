#include "reckon/models/suite.h"

namespace reckon::models {

int Channels(const Sample& sample) {
  if (const auto* encoders = std::get_if<EncoderSample>(&sample)) {
    return static_cast<int>(encoders->angle_rad.size());
  }
  if (const auto* contacts = std::get_if<ContactSample>(&sample)) {
    return static_cast<int>(contacts->probability.size());
  }
  if (const auto* torques = std::get_if<TorqueSample>(&sample)) {
    return static_cast<int>(torques->torque_n_m.size());
  }
  if (const auto* forces = std::get_if<FootForceSample>(&sample)) {
    return static_cast<int>(forces->force_n.size());
  }
  return 0;
}

std::optional<SensorId> Suite::Find(const std::string& name) const {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].name == name) return static_cast<SensorId>(i);
  }
  return std::nullopt;
}

}  // namespace reckon::models
