#pragma once

#include <string>
#include <vector>

#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// Says of every foot 1 if it stands and 0 if it does not: c_i = [f_n,i > 1 N] of the true normal
/// force, or what the gait's schedule has at that instant.
class ContactSensor : public Sensor {
 public:
  ContactSensor(const std::string& name, models::SensorId id, const ContactSensorConfig& config,
                models::TimeNs physics_step_ns);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  models::SensorId id_;
  SampleClock clock_;
  ContactSource source_;
};

}  // namespace reckon::sim
