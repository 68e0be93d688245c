#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace reckon::models {

/// A velocity over ground: v of the sensor's origin in W, expressed in the sensor's frame S [m/s],
/// with the covariance that the sensor delivers with it [m²/s²]. A sensor that has lost the ground
/// says so: then `valid` is false and the numbers are NaN, never zero.
struct BodyVelocitySample {
  Eigen::Vector3d v_WS_S = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  bool valid = true;
  bool over_ground = true;  ///< false: relative to the water around the sensor
  /// How badly the sensor's beams contradict each other [m/s]; 0: they don't, or it has none.
  double figure_of_merit_m_s = 0.0;
  std::uint8_t beams = 0;  ///< bit i: beam i had an answer
};

}  // namespace reckon::models
