#include "reckon/sim/body_velocity_sensor.h"

#include <cassert>

namespace reckon::sim {

BodyVelocitySensor::BodyVelocitySensor(const std::string& name, models::SensorId id,
                                       const models::Pose& X_BS, const BodyVelocityConfig& config,
                                       std::uint64_t seed, models::TimeNs physics_step_ns)
    : id_(id),
      X_BS_(X_BS),
      clock_(name, config.timing, physics_step_ns),
      sigma_(config.noise_m_per_s),
      noise_draws_(seed, name + ".noise") {
  for (int i = 0; i < 3; ++i) RequireNotNegative(name, "noise_m_per_s", sigma_[i]);
}

void BodyVelocitySensor::Observe(const MotionWindow& motion,
                                 std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  models::BodyVelocitySample sample;
  sample.v_WS_S = (motion.X_WB.R * X_BS_.R).transpose() * motion.Velocity(X_BS_.p);
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (sigma_[i] > 0.0) sample.v_WS_S[i] += sigma_[i] * noise_draws_.Normal(i, clock_.index());
  }
  sample.covariance = sigma_.cwiseAbs2().asDiagonal();
  out.push_back({id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), sample});
  clock_.Advance();
}

}  // namespace reckon::sim
