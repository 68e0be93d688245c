#pragma once

#include <Eigen/Core>

namespace reckon::sim {

/// Where a swinging foot should be.
struct SwingPoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< in W
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
};

/// A foot's way through the air: over the ground by a quintic that arrives after 0.95 of the swing,
/// up by a quintic to `lift_m` above the higher end at 0.45 of it, and down by a cubic that arrives
/// with `touch_down_m_s`.
///
/// `s` is how far the swing is, 0 to 1, of `duration_s`. Does not allocate.
SwingPoint SwingAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double s,
                   double duration_s, double lift_m, double touch_down_m_s);

}  // namespace reckon::sim
