#include "reckon/sim/contact_sensor.h"

namespace reckon::sim {

ContactSensor::ContactSensor(const std::string& name, models::SensorId id,
                             const ContactSensorConfig& config, models::TimeNs physics_step_ns)
    : id_(id), clock_(name, config.timing, physics_step_ns), source_(config.source) {}

void ContactSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  if (!clock_.IsSample(motion.t_ns)) return;
  models::ContactSample sample;
  sample.probability = motion.gait;
  if (source_ == ContactSource::kTruth) {
    sample.probability.resize(motion.feet.count);
    for (int i = 0; i < motion.feet.count; ++i) {
      sample.probability[i] = motion.feet.foot[i].contact ? 1.0 : 0.0;
    }
  }
  const models::TimeNs t_ns = clock_.next_ns();
  out.push_back({id_, clock_.Valid(t_ns), clock_.Arrival(t_ns), sample});
  clock_.Advance();
}

}  // namespace reckon::sim
