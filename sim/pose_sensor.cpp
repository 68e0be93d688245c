#include "reckon/sim/pose_sensor.h"

#include <cassert>

#include "reckon/sim/rotation_vector.h"

namespace reckon::sim {
namespace {

/// σ times a standard normal draw for each axis.
Eigen::Vector3d Noise(const Eigen::Vector3d& sigma, const RandomStream& draws,
                      std::uint64_t index) {
  Eigen::Vector3d noise = Eigen::Vector3d::Zero();
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (sigma[i] > 0.0) noise[i] = sigma[i] * draws.Normal(i, index);
  }
  return noise;
}

}  // namespace

PoseSensor::PoseSensor(const std::string& name, models::SensorId id, const models::Pose& X_BS,
                       const PoseConfig& config, std::uint64_t seed, models::TimeNs physics_step_ns)
    : id_(id),
      X_BS_(X_BS),
      clock_(name, config.timing, physics_step_ns),
      position_sigma_(config.noise_position_m),
      orientation_sigma_(config.noise_orientation_rad),
      has_orientation_(config.orientation),
      position_draws_(seed, name + ".position_noise"),
      orientation_draws_(seed, name + ".orientation_noise") {
  for (int i = 0; i < 3; ++i) {
    RequireNotNegative(name, "noise_position_m", position_sigma_[i]);
    RequireNotNegative(name, "noise_orientation_rad", orientation_sigma_[i]);
  }
}

void PoseSensor::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (!clock_.IsSample(motion.t_ns)) return;
  const models::Pose X_WS = motion.X_WB * X_BS_;
  models::PoseSample sample;
  sample.X_WS.p = X_WS.p + Noise(position_sigma_, position_draws_, clock_.index());
  sample.position_sigma_m = position_sigma_.cwiseMax(kLeastPoseSigma);
  sample.has_orientation = has_orientation_;
  if (has_orientation_) {
    const Eigen::Vector3d turn = Noise(orientation_sigma_, orientation_draws_, clock_.index());
    sample.X_WS.R = RotationExp(turn) * X_WS.R;
    sample.orientation_sigma_rad = orientation_sigma_.cwiseMax(kLeastPoseSigma);
  }
  out.push_back({id_, clock_.Valid(motion.t_ns), clock_.Arrival(motion.t_ns), sample});
  clock_.Advance();
}

}  // namespace reckon::sim
