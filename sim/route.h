#pragma once

#include <vector>

#include <Eigen/Core>

namespace reckon::sim {

/// A line of straight pieces in W, followed from its first point to its last.
class Route {
 public:
  /// At least one point; points that coincide with the one before are dropped.
  explicit Route(const std::vector<Eigen::Vector3d>& points);

  double length() const { return reached_.back(); }

  /// The point at arc length s, which is held within the route; and the piece's direction there
  /// (zero for a route of one point). Neither allocates.
  Eigen::Vector3d At(double s) const;
  Eigen::Vector3d Direction(double s) const;

  /// The arc length in [s, s + window] whose point lies nearest to `p`. Does not allocate.
  double Nearest(const Eigen::Vector3d& p, double s, double window) const;

 private:
  std::size_t PieceAt(double s) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> reached_;  ///< arc length of each point
};

}  // namespace reckon::sim
