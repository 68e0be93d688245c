#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/sim/load_noise.h"
#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// The torques of the joints' motors, in the order of the joints: as the controller asked for them,
/// exactly, or as the motors gave them, through `LoadNoise`.
class TorqueSensor : public Sensor {
 public:
  TorqueSensor(const std::string& name, models::SensorId id, const TorqueConfig& config,
               std::uint64_t seed, models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  SampleClock clock_;
  TorqueSource source_;
  LoadNoise noise_;
};

/// The true normal force on each foot, through `LoadNoise`.
class FootForceSensor : public Sensor {
 public:
  FootForceSensor(const std::string& name, models::SensorId id, const FootForceConfig& config,
                  std::uint64_t seed, models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  SampleClock clock_;
  LoadNoise noise_;
};

}  // namespace reckon::sim
