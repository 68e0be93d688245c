#include "reckon/sim/load_sensors.h"

#include <cassert>

namespace reckon::sim {

TorqueSensor::TorqueSensor(const std::string& name, models::SensorId id, const TorqueConfig& config,
                           std::uint64_t seed, models::TimeNs physics_step_ns)
    : id_(id),
      clock_(name, config.timing, physics_step_ns),
      source_(config.source),
      noise_(name, "n_m", config.errors, seed) {}

void TorqueSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  models::TorqueSample sample{motion.joint_command_n_m};
  if (source_ == TorqueSource::kMeasured) {
    sample.torque_n_m = motion.joint_torque_n_m;
    std::uint32_t channel = 0;
    for (double& torque : sample.torque_n_m)
      torque = noise_.Read(torque, channel++, clock_.index());
  }
  out.push_back({id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), sample});
  clock_.Advance();
}

FootForceSensor::FootForceSensor(const std::string& name, models::SensorId id,
                                 const FootForceConfig& config, std::uint64_t seed,
                                 models::TimeNs physics_step_ns)
    : id_(id),
      clock_(name, config.timing, physics_step_ns),
      noise_(name, "n", config.errors, seed) {}

void FootForceSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  models::FootForceSample sample;
  sample.force_n.resize(motion.feet.count);
  for (int i = 0; i < motion.feet.count; ++i) {
    sample.force_n[i] = noise_.Read(motion.feet.foot[static_cast<std::size_t>(i)].normal_n,
                                    static_cast<std::uint32_t>(i), clock_.index());
  }
  out.push_back({id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), sample});
  clock_.Advance();
}

}  // namespace reckon::sim
