#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace reckon::sim {

/// Heading of a body: the direction of its x axis over the horizontal plane, from W's x towards y.
inline double HeadingOf(const Eigen::Matrix3d& R_WB) { return std::atan2(R_WB(1, 0), R_WB(0, 0)); }

/// Whether a body leans by more than 75°, on its way to lie on its side or back.
inline bool IsOverturned(const Eigen::Matrix3d& R_WB) {
  constexpr double kMaxTiltDeg = 75.0;
  static const double least_upright = std::cos(kMaxTiltDeg * std::numbers::pi / 180.0);
  return R_WB(2, 2) < least_upright;
}

}  // namespace reckon::sim
