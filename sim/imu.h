#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/sim/low_pass.h"
#include "reckon/sim/sample_clock.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"
#include "reckon/sim/triad_noise.h"

namespace reckon::sim {

/// The highest bandwidth that the anti-alias filter can have [Hz]: half the physics rate.
inline double LargestBandwidthHz(models::TimeNs physics_step_ns) {
  return 0.5 / models::Seconds(physics_step_ns);
}

/// An inertial measurement unit, made from poses: p_S = p + R p_BS, R_S = R R_BS, and v_S by
/// central difference. Over a sample's interval [i, j], in mode `increment`,
///     Δθ = Log(R_S,iᵀ R_S,j),  Δv = R_S,iᵀ (v_S,j − v_S,i − g Δt),
///     ω = Δθ/Δt,  a = Γ1(Δθ)⁻¹ Δv/Δt,  then the errors of both triads,
/// so that the recursion of an ideal inertial navigation reproduces R and v to round-off. Mode
/// `point` gives instantaneous values at j instead, ω = Log(R_S,j−1ᵀ R_S,j+1)/2h and
/// a = R_S,jᵀ ((p_S,j+1 − 2 p_S,j + p_S,j−1)/h² − g): they alias whatever moves between two
/// samples, and are there for comparison.
///
/// With a bandwidth, ω and a of every physics step pass a low-pass first, and a sample of mode
/// `increment` integrates the filtered ones over its interval. The bandwidth does not touch the
/// noise, which stays white. The range then clips what the filter is given, step by step, as a
/// short impact clips in the sensing element and not in the mean of a sample; a sample of which any
/// step was clipped says that it is saturated.
class Imu : public Sensor {
 public:
  Imu(const std::string& name, models::SensorId id, const models::Pose& X_BS,
      const ImuConfig& config, std::uint64_t seed, models::TimeNs physics_step_ns,
      double gravity_m_s2);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

  /// The biases in S that the next sample will carry.
  const Eigen::Vector3d& gyro_bias() const { return gyro_.bias(); }
  const Eigen::Vector3d& accel_bias() const { return accel_.bias(); }

 private:
  /// Rotation and velocity of S in W at an instant.
  struct Instant {
    Eigen::Matrix3d R_WS;
    Eigen::Vector3d v_WS;
  };
  /// What S feels, in S: angular velocity and specific force.
  struct Inertial {
    Eigen::Vector3d gyro, accel;
  };
  struct Filter {
    LowPass gyro, accel;
  };

  Instant At(const MotionWindow& motion) const;
  Inertial Mean(const Instant& begin, const Instant& end, double dt_s) const;
  Inertial Point(const MotionWindow& motion) const;
  Inertial Filtered(const Inertial& raw);
  Inertial Clipped(const Inertial& raw);
  void Integrate(const Inertial& step);
  Inertial Integral() const;
  void Publish(const Inertial& truth, std::vector<models::Measurement>& out);

  models::SensorId id_;
  models::Pose X_BS_;
  ImuMode mode_;
  SampleClock clock_;
  double step_s_, period_s_;
  Eigen::Vector3d g_W_;
  TriadNoise gyro_, accel_;
  double gyro_range_, accel_range_;
  bool gyro_clipped_ = false, accel_clipped_ = false;  ///< since the last sample
  std::optional<Filter> filter_;
  Instant begin_;              ///< of the interval; with a filter: of the step
  Eigen::Matrix3d R_begin_S_;  ///< with a filter: turned since the interval's start, and
  Eigen::Vector3d dv_begin_;   ///< velocity gained, both in the axes of S then
};

}  // namespace reckon::sim
