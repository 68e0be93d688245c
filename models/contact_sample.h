#pragma once

#include <Eigen/Core>

namespace reckon::models {

/// The most feet that a robot can have (bounded: no step allocates).
inline constexpr int kMaxFeet = 4;

using FootVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxFeet, 1>;

/// Which feet stand: the probability of contact of each, 0 to 1, in the order of the robot's legs.
/// A switch says 0 or 1.
struct ContactSample {
  FootVector probability;
};

}  // namespace reckon::models
