#include "reckon/sim/imu.h"

#include <cassert>
#include <sstream>

#include "reckon/sim/rotation_vector.h"

namespace reckon::sim {

Imu::Imu(const std::string& name, models::SensorId id, const models::Pose& X_BS,
         const ImuConfig& config, std::uint64_t seed, models::TimeNs physics_step_ns,
         double gravity_m_s2)
    : id_(id),
      X_BS_(X_BS),
      mode_(config.mode),
      clock_(name, config.timing, physics_step_ns),
      step_s_(models::Seconds(physics_step_ns)),
      period_s_(models::Seconds(clock_.period_ns())),
      g_W_(0.0, 0.0, -gravity_m_s2),
      gyro_(name, "gyro", config.gyro, period_s_, seed),
      accel_(name, "accel", config.accel, period_s_, seed),
      gyro_range_(config.gyro.range),
      accel_range_(config.accel.range),
      R_begin_S_(Eigen::Matrix3d::Identity()),
      dv_begin_(Eigen::Vector3d::Zero()) {
  if (config.accel.g_sensitivity != 0.0) {
    RefuseField(name, "accel.g_sensitivity", config.accel.g_sensitivity,
                "0: only a gyroscope has one");
  }
  RequireNotNegative(name, "bandwidth_hz", config.bandwidth_hz);
  if (config.bandwidth_hz == 0.0) return;
  if (config.bandwidth_hz > LargestBandwidthHz(physics_step_ns)) {
    std::ostringstream allowed;
    allowed << "at most half the physics rate, " << LargestBandwidthHz(physics_step_ns) << " Hz";
    RefuseField(name, "bandwidth_hz", config.bandwidth_hz, allowed.str());
  }
  if (config.bandwidth_poles != 1 && config.bandwidth_poles != 2) {
    RefuseField(name, "bandwidth_poles", config.bandwidth_poles, "1 or 2");
  }
  const LowPass low_pass(config.bandwidth_hz, config.bandwidth_poles, step_s_);
  filter_ = Filter{low_pass, low_pass};
}

void Imu::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  if (motion.t_ns == 0) begin_ = At(motion);
  if (filter_ && mode_ == ImuMode::kIncrement && motion.t_ns > 0) {
    const Instant now = At(motion);
    Integrate(Filtered(Mean(begin_, now, step_s_)));
    begin_ = now;
  }
  const bool is_sample = clock_.IsSample(motion.t_ns);
  if (mode_ == ImuMode::kPoint) {
    if (!filter_ && !is_sample) return;
    const Inertial point = Point(motion);
    const Inertial truth = filter_ ? Filtered(point) : point;
    if (is_sample) Publish(truth, out);
  } else if (is_sample && filter_) {
    Publish(Integral(), out);
    R_begin_S_.setIdentity();
    dv_begin_.setZero();
  } else if (is_sample) {
    const Instant now = At(motion);
    Publish(Mean(begin_, now, period_s_), out);
    begin_ = now;
  }
}

Imu::Instant Imu::At(const MotionWindow& motion) const {
  return {motion.X_WB.R * X_BS_.R, motion.Velocity(X_BS_.p)};
}

Imu::Inertial Imu::Mean(const Instant& begin, const Instant& end, double dt_s) const {
  const Eigen::Vector3d dtheta = RotationLog(begin.R_WS.transpose() * end.R_WS);
  const Eigen::Vector3d dv = begin.R_WS.transpose() * (end.v_WS - begin.v_WS - g_W_ * dt_s);
  return {dtheta / dt_s, Gamma1Inverse(dtheta) * dv / dt_s};
}

Imu::Inertial Imu::Point(const MotionWindow& motion) const {
  const models::Pose X_previous = motion.X_WB_previous * X_BS_;
  const models::Pose X = motion.X_WB * X_BS_;
  const models::Pose X_next = motion.X_WB_next * X_BS_;
  const Eigen::Vector3d a_WS = (X_next.p - 2.0 * X.p + X_previous.p) / (step_s_ * step_s_);
  return {RotationLog(X_previous.R.transpose() * X_next.R) / (2.0 * step_s_),
          X.R.transpose() * (a_WS - g_W_)};
}

Imu::Inertial Imu::Filtered(const Inertial& raw) {
  const Inertial clipped = Clipped(raw);
  return {filter_->gyro.Step(clipped.gyro), filter_->accel.Step(clipped.accel)};
}

Imu::Inertial Imu::Clipped(const Inertial& raw) {
  const auto clip = [](const Eigen::Vector3d& u, double range, bool& clipped) -> Eigen::Vector3d {
    if (range == 0.0 || u.cwiseAbs().maxCoeff() <= range) return u;
    clipped = true;
    return u.cwiseMax(-range).cwiseMin(range);
  };
  return {clip(raw.gyro, gyro_range_, gyro_clipped_),
          clip(raw.accel, accel_range_, accel_clipped_)};
}

void Imu::Integrate(const Inertial& step) {
  const Eigen::Vector3d dtheta = step.gyro * step_s_;
  dv_begin_ += R_begin_S_ * (Gamma1(dtheta) * step.accel) * step_s_;
  R_begin_S_ = (R_begin_S_ * RotationExp(dtheta)).eval();
}

Imu::Inertial Imu::Integral() const {
  const Eigen::Vector3d dtheta = RotationLog(R_begin_S_);
  return {dtheta / period_s_, Gamma1Inverse(dtheta) * dv_begin_ / period_s_};
}

void Imu::Publish(const Inertial& truth, std::vector<models::Measurement>& out) {
  const TriadNoise::Reading gyro = gyro_.Read(truth.gyro, truth.accel);
  const TriadNoise::Reading accel = accel_.Read(truth.accel, truth.accel);
  models::ImuSample sample;
  sample.gyro_rad_s = gyro.value;
  sample.accel_m_s2 = accel.value;
  sample.interval_ns = clock_.period_ns();
  sample.gyro_saturated = gyro.saturated || gyro_clipped_;
  sample.accel_saturated = accel.saturated || accel_clipped_;
  gyro_clipped_ = accel_clipped_ = false;
  const models::TimeNs t_ns = clock_.next_ns();
  out.push_back({id_, clock_.Valid(t_ns), clock_.Arrival(t_ns), sample});
  clock_.Advance();
}

}  // namespace reckon::sim
