#include "reckon/sim/depth_sensor.h"

#include <cassert>
#include <cmath>

namespace reckon::sim {

DepthSensor::DepthSensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
                         const DepthConfig& config, std::uint64_t seed,
                         models::TimeNs physics_step_ns)
    : id_(id),
      p_BS_(X_BS.p),
      clock_(name, config.timing, physics_step_ns),
      sigma_(config.noise_m),
      resolution_(config.resolution_m),
      offset_(config.offset_m * RandomStream(seed, name + ".offset").Normal(0, 0)),
      noise_draws_(seed, name + ".noise") {
  RequireNotNegative(name, "noise_m", config.noise_m);
  RequireNotNegative(name, "offset_m", config.offset_m);
  RequireNotNegative(name, "resolution_m", config.resolution_m);
}

void DepthSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  double depth = -(motion.X_WB * p_BS_).z() + offset_;
  if (sigma_ > 0.0) depth += sigma_ * noise_draws_.Normal(0, clock_.index());
  if (resolution_ > 0.0) depth = resolution_ * std::round(depth / resolution_);
  out.push_back(
      {id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), models::DepthSample{depth}});
  clock_.Advance();
}

}  // namespace reckon::sim
