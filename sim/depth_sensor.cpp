#include "reckon/sim/depth_sensor.h"

#include <cassert>
#include <cmath>

namespace reckon::sim {

DepthSensor::DepthSensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
                         const DepthConfig& config, std::uint64_t seed,
                         const Environment& environment)
    : id_(id),
      p_BS_(X_BS.p),
      clock_(name, config.timing, environment.step_ns),
      sigma_(config.noise_m),
      resolution_(config.resolution_m),
      offset_(config.offset_m * RandomStream(seed, name + ".offset").Normal(0, 0)),
      gain_(config.assumed_density_kg_m3 > 0.0
                ? environment.water_density_kg_m3 / config.assumed_density_kg_m3
                : 1.0),
      drift_sigma_(config.surface_drift_m_per_s_sqrt_hz *
                   std::sqrt(models::Seconds(clock_.period_ns()))),
      noise_draws_(seed, name + ".noise"),
      drift_draws_(seed, name + ".drift") {
  RequireNotNegative(name, "noise_m", config.noise_m);
  RequireNotNegative(name, "offset_m", config.offset_m);
  RequireNotNegative(name, "resolution_m", config.resolution_m);
  RequireNotNegative(name, "assumed_density_kg_m3", config.assumed_density_kg_m3);
  RequireNotNegative(name, "surface_drift_m_per_s_sqrt_hz", config.surface_drift_m_per_s_sqrt_hz);
}

void DepthSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  if (drift_sigma_ > 0.0) drift_ += drift_sigma_ * drift_draws_.Normal(0, clock_.index());
  double depth = -(motion.X_WB * p_BS_).z() * gain_ + offset_ + drift_;
  if (sigma_ > 0.0) depth += sigma_ * noise_draws_.Normal(0, clock_.index());
  if (resolution_ > 0.0) depth = resolution_ * std::round(depth / resolution_);
  out.push_back(
      {id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), models::DepthSample{depth}});
  clock_.Advance();
}

}  // namespace reckon::sim
