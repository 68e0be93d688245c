#pragma once

#include <Eigen/Core>

#include "reckon/estimator/filter_beliefs.h"

namespace reckon::estimator {

/// What a second source says of the angular rate in I: of the axes from `first` on, and the
/// variance of one [(rad/s)²].
struct SecondRate {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  double variance = 0.0;
  int first = 0;
  bool from_imu = true;  ///< it has a bias
};

/// Of another IMU, or of the wheels, which turn the robot about its own vertical: the gyro filter's
/// source. Does not allocate.
SecondRate ReadSecondRate(const models::Measurement& m, const FilterBeliefs& beliefs);

}  // namespace reckon::estimator
