#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/prior.h"
#include "reckon/estimator/rest_average.h"
#include "reckon/estimator/setup.h"

namespace reckon::estimator {

/// Finds the first state from a resting IMU: gyroscope bias from the mean rate, and the smallest
/// turn of the prior's orientation that makes the mean specific force point upwards. Position and
/// accelerometer bias, and with that turn the yaw, are the prior's. With G = −g and ζ_a the
/// error of the accelerometer bias that the prior gives,
///     θ × G = R̂ (ζ_a − n):   tilt and accelerometer bias start correlated.
/// It refuses to run while the robot moves: a sample or a wheel that speaks of motion starts the
/// averaging over. Does not allocate.
class StaticInitialiser {
 public:
  enum class Progress { kWaiting, kMoving, kDone };

  StaticInitialiser(const Setup& setup, double imu_period_s);

  void Start(const Prior& prior);

  /// One IMU sample in the axes of I, over `dt_s`.
  Progress Add(const Eigen::Vector3d& w, const Eigen::Vector3d& a, double dt_s);

  /// A wheel rate [rad/s]; one that is not zero starts the averaging over, and gives false.
  bool AddWheelRate(double rate_rad_s);

  /// The state of I and its right-invariant covariance, once Add has said kDone. `p_BI` is the
  /// IMU's origin in the body.
  NavigationState State(const Eigen::Vector3d& p_BI) const;
  ErrorCovariance Covariance() const;

 private:
  Eigen::Matrix3d Rotation() const;

  Setup setup_;
  Prior prior_;
  RestAverage rest_;
};

}  // namespace reckon::estimator
