#pragma once

#include <Eigen/Core>

#include "reckon/estimator/estimate.h"
#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::estimator {

/// Where a filter starts: the body's state and the covariance of its right-invariant error. A
/// filter moves both to its IMU and to its own error form itself, so that all filters start alike.
struct Prior {
  models::TimeNs t_ns = 0;
  models::Pose X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WB_B =
      Eigen::Vector3d::Zero();  ///< believed turn rate: carries v over the lever arm
  Eigen::Vector3d gyro_bias_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias_m_s2 = Eigen::Vector3d::Zero();
  ErrorCovariance covariance = ErrorCovariance::Zero();
};

}  // namespace reckon::estimator
