#pragma once

#include <Eigen/Core>

namespace reckon::models {

/// A velocity over ground: v of the sensor's origin in W, expressed in the sensor's frame S [m/s],
/// with the covariance that the sensor delivers with it [m²/s²].
struct BodyVelocitySample {
  Eigen::Vector3d v_WS_S = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace reckon::models
