#pragma once

#include <cmath>

#include "estimator/carried_body.h"
#include "reckon/estimator/error_form.h"

namespace reckon::testing_estimator {

/// A body that turns and accelerates on every axis, with a velocity sensor beside its
/// IMU.
class SimulatedDrive : public CarriedBody {
 public:
  SimulatedDrive(const estimator::Setup& setup, std::uint64_t seed, double noise_scale = 1.0)
      : CarriedBody(setup, seed, noise_scale) {
    x_.R = draws_.Rotation();
    x_.v = draws_.Vector(0.5);
    w_ = Rate(0.0);
  }

  /// The next IMU sample, after which the truth is at its end.
  Measurement Advance() {
    const double t = models::Seconds(t_ns_) + 0.5 * kDt;
    const Eigen::Vector3d acceleration(std::cos(0.9 * t), std::sin(1.1 * t), 0.3 * std::cos(2 * t));
    const Measurement imu = Carry(Rate(t), x_.R.transpose() * (acceleration - gravity()));
    const auto walk = [&](double density) {
      return draws_.Vector(scale_ * density * std::sqrt(kDt));
    };
    x_.gyro_bias += walk(setup_.noise.gyro_bias_walk_rad_per_s2_sqrt_hz);
    x_.accel_bias += walk(setup_.noise.accel_bias_walk_m_per_s3_sqrt_hz);
    return imu;
  }

  /// The velocity sensor now.
  Measurement Velocity(double sigma) {
    const models::Pose& X_BS = setup_.suite.sensors[kVelocity].X_BS;
    const estimator::NavigationState body = Body();
    const Eigen::Vector3d v_S = body.v + body.R * w_.cross(X_BS.p);
    return VelocityAt(t_ns_,
                      X_BS.R.transpose() * body.R.transpose() * v_S + draws_.Vector(scale_ * sigma),
                      sigma);
  }

 private:
  static Eigen::Vector3d Rate(double t) {
    return {0.3 * std::sin(t), 0.2 * std::cos(1.3 * t), 0.5 * std::sin(0.7 * t)};
  }
};

inline estimator::NavigationState StateOf(const estimator::Estimate& e) {
  return {e.X_WB.R, e.v_WB, e.X_WB.p, e.gyro_bias_rad_s, e.accel_bias_m_s2};
}

/// The estimate's error in its own coordinates.
inline estimator::ErrorVector ErrorOf(const estimator::Estimate& estimate,
                                      const estimator::NavigationState& truth) {
  return estimator::ErrorBetween(estimate.form, StateOf(estimate), truth);
}

/// Quantile of χ² for many degrees of freedom (Wilson and Hilferty), at z standard normal.
inline double ChiSquareAt(double z, double dof) {
  const double c = 2.0 / (9.0 * dof);
  return dof * std::pow(1.0 - c + z * std::sqrt(c), 3);
}

}  // namespace reckon::testing_estimator
