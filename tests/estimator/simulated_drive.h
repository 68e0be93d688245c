#pragma once

#include <cmath>

#include "estimator/draws.h"
#include "estimator/robot.h"
#include "reckon/estimator/error_form.h"

namespace reckon::testing_estimator {

/// A body that turns and accelerates on every axis, carried by the estimator's own recursion, with
/// the IMU and the velocity sensor that its filter believes in: ideal on purpose.
class SimulatedDrive {
 public:
  SimulatedDrive(const estimator::Setup& setup, std::uint64_t seed, double noise_scale = 1.0)
      : setup_(setup), draws_(seed), scale_(noise_scale) {
    x_.R = draws_.Rotation();
    x_.v = draws_.Vector(0.5);
    w_ = Rate(0.0);
  }

  /// The next IMU sample, after which the truth is at its end.
  Measurement Advance() {
    const double dt = 5e-3;
    const double t = models::Seconds(t_ns_) + 0.5 * dt;
    const Eigen::Vector3d g(0, 0, -setup_.gravity_m_s2);
    w_ = Rate(t);
    const Eigen::Vector3d acceleration(std::cos(0.9 * t), std::sin(1.1 * t), 0.3 * std::cos(2 * t));
    const Eigen::Vector3d a = x_.R.transpose() * (acceleration - g);
    const estimator::Noise& n = setup_.noise;
    const auto white = [&](double density) {
      return draws_.Vector(scale_ * density / std::sqrt(dt));
    };
    const auto walk = [&](double density) {
      return draws_.Vector(scale_ * density * std::sqrt(dt));
    };
    const Eigen::Matrix3d R_SB = setup_.suite.sensors[kImu].X_BS.R.transpose();
    models::ImuSample sample;
    sample.interval_ns = 5 * kMs;
    sample.gyro_rad_s = R_SB * (w_ + x_.gyro_bias + white(n.gyro_noise_density_rad_per_s_sqrt_hz));
    sample.accel_m_s2 = R_SB * (a + x_.accel_bias + white(n.accel_noise_density_m_per_s2_sqrt_hz));
    x_ = estimator::Propagated(x_, {w_, a, dt}, g);
    x_.gyro_bias += walk(n.gyro_bias_walk_rad_per_s2_sqrt_hz);
    x_.accel_bias += walk(n.accel_bias_walk_m_per_s3_sqrt_hz);
    t_ns_ += 5 * kMs;
    return {kImu, t_ns_, t_ns_, sample};
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

  /// The true state of the body: B's origin instead of I's.
  estimator::NavigationState Body() const {
    const Eigen::Vector3d& p_BI = setup_.suite.sensors[kImu].X_BS.p;
    estimator::NavigationState body = x_;
    body.p -= x_.R * p_BI;
    body.v -= x_.R * w_.cross(p_BI);
    return body;
  }

  /// The truth with a right-invariant error drawn from `covariance` (diagonal).
  estimator::Prior DrawPrior(const estimator::ErrorCovariance& covariance) {
    const estimator::NavigationState body = Body();
    const estimator::ErrorVector e =
        covariance.diagonal().cwiseSqrt().cwiseProduct(draws_.Normals<15>()) * scale_;
    const Eigen::Vector3d theta = e.segment<3>(estimator::kTheta);
    const Eigen::Matrix3d turn = estimator::Exp(theta), J = estimator::LeftJacobian(theta);
    estimator::Prior prior;
    prior.t_ns = t_ns_;
    prior.X_WB = {turn * body.R, turn * body.p + J * e.segment<3>(estimator::kPosition)};
    prior.v_WB = turn * body.v + J * e.segment<3>(estimator::kVelocity);
    prior.w_WB_B = w_;
    prior.gyro_bias_rad_s = body.gyro_bias + e.segment<3>(estimator::kGyroBias);
    prior.accel_bias_m_s2 = body.accel_bias + e.segment<3>(estimator::kAccelBias);
    prior.covariance = covariance;
    return prior;
  }

  TimeNs t_ns() const { return t_ns_; }

 private:
  static Eigen::Vector3d Rate(double t) {
    return {0.3 * std::sin(t), 0.2 * std::cos(1.3 * t), 0.5 * std::sin(0.7 * t)};
  }

  estimator::Setup setup_;
  Draws draws_;
  double scale_;  ///< of every error; 0: a perfect world
  TimeNs t_ns_ = 0;
  estimator::NavigationState x_;  ///< of I
  Eigen::Vector3d w_;
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
