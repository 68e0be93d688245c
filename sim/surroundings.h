#pragma once

#include <optional>

#include <Eigen/Core>

namespace reckon::sim {

/// Where a ray meets something.
struct RayHit {
  double range_m = 0.0;
  double cos_incidence = 1.0;  ///< of the angle between the ray and the surface's normal
};

/// What lies around the robot and does not move, seen along rays; the robot itself is no part of
/// it.
class Surroundings {
 public:
  virtual ~Surroundings() = default;

  /// What a ray from `from` along the unit vector `direction`, both in W, meets first. Does not
  /// allocate.
  virtual std::optional<RayHit> Cast(const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& direction) const = 0;
};

}  // namespace reckon::sim
