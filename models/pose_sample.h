#pragma once

#include <Eigen/Core>

#include "reckon/models/pose.h"

namespace reckon::models {

/// An absolute pose of the sensor's frame S in W from outside (satellites, motion capture, a map),
/// with the standard deviations that are delivered with it, along and about the axes of W.
struct PoseSample {
  Pose X_WS;
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation_sigma_rad = Eigen::Vector3d::Zero();  ///< of Log(R_measured Rᵀ)
  bool has_orientation = true;  ///< false: a position alone; `X_WS.R` says nothing
};

}  // namespace reckon::models
