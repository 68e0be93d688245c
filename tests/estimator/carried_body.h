#pragma once

#include <cmath>

#include "estimator/draws.h"
#include "estimator/robot.h"

namespace reckon::testing_estimator {

/// A prior that differs from the body's true state, turning at `w`, by a right-invariant error
/// drawn from a diagonal covariance, `scale` times.
inline estimator::Prior DrawnPrior(const estimator::NavigationState& body, const Eigen::Vector3d& w,
                                   const estimator::ErrorCovariance& covariance, Draws& draws,
                                   double scale = 1.0) {
  const estimator::ErrorVector e =
      covariance.diagonal().cwiseSqrt().cwiseProduct(draws.Normals<15>()) * scale;
  const Eigen::Vector3d theta = e.segment<3>(estimator::kTheta);
  const Eigen::Matrix3d turn = estimator::Exp(theta), J = estimator::LeftJacobian(theta);
  estimator::Prior prior;
  prior.X_WB = {turn * body.R, turn * body.p + J * e.segment<3>(estimator::kPosition)};
  prior.v_WB = turn * body.v + J * e.segment<3>(estimator::kVelocity);
  prior.w_WB_B = w;
  prior.gyro_bias_rad_s = body.gyro_bias + e.segment<3>(estimator::kGyroBias);
  prior.accel_bias_m_s2 = body.accel_bias + e.segment<3>(estimator::kAccelBias);
  prior.covariance = covariance;
  return prior;
}

/// A body that the estimator's own recursion carries in steps of 5 ms, with the IMU that its filter
/// believes in: ideal on purpose.
class CarriedBody {
 public:
  /// The true state of the body: B's origin instead of I's.
  estimator::NavigationState Body() const {
    estimator::NavigationState body = x_;
    body.p -= x_.R * p_BI();
    body.v -= x_.R * w_.cross(p_BI());
    return body;
  }

  /// The truth with an error drawn from `covariance` (diagonal).
  estimator::Prior DrawPrior(const estimator::ErrorCovariance& covariance) {
    estimator::Prior prior = DrawnPrior(Body(), w_, covariance, draws_, scale_);
    prior.t_ns = t_ns_;
    return prior;
  }

  TimeNs t_ns() const { return t_ns_; }

 protected:
  static constexpr double kDt = 5e-3;

  CarriedBody(const estimator::Setup& setup, std::uint64_t seed, double noise_scale = 1.0)
      : setup_(setup), draws_(seed), scale_(noise_scale) {}

  const Eigen::Vector3d& p_BI() const { return setup_.suite.sensors[kImu].X_BS.p; }
  Eigen::Vector3d gravity() const { return {0, 0, -setup_.gravity_m_s2}; }

  /// Moves the truth on by a rate and a specific force that are held; what the IMU read.
  Measurement Carry(const Eigen::Vector3d& w, const Eigen::Vector3d& a) {
    const estimator::Noise& n = setup_.noise;
    const auto white = [&](double density) {
      return draws_.Vector(scale_ * density / std::sqrt(kDt));
    };
    const Eigen::Matrix3d R_SB = setup_.suite.sensors[kImu].X_BS.R.transpose();
    models::ImuSample sample;
    sample.interval_ns = 5 * kMs;
    sample.gyro_rad_s = R_SB * (w + x_.gyro_bias + white(n.gyro_noise_density_rad_per_s_sqrt_hz));
    sample.accel_m_s2 = R_SB * (a + x_.accel_bias + white(n.accel_noise_density_m_per_s2_sqrt_hz));
    x_ = estimator::Propagated(x_, {w, a, kDt}, gravity());
    w_ = w;
    t_ns_ += 5 * kMs;
    return {kImu, t_ns_, t_ns_, sample};
  }

  estimator::Setup setup_;
  Draws draws_;
  double scale_;  ///< of every error; 0: a perfect world
  TimeNs t_ns_ = 0;
  estimator::NavigationState x_;  ///< of I
  Eigen::Vector3d w_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::testing_estimator
