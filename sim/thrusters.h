#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reckon/sim/hydrodynamics.h"

namespace reckon::sim {

struct ThrusterConfig {
  Eigen::Vector3d p_BT_m = Eigen::Vector3d::Zero();      ///< where it pushes
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< that positive thrust takes, in B
  double limit_n = 40.0;                                 ///< either way
  double lag_s = 0.08;                                   ///< of first order
};

/// Thrusters fixed in a body. A wanted wrench is shared by least squares (the smallest thrusts that
/// come nearest to it), scaled down as a whole where one would exceed its limit, so that its
/// direction stays; each thrust follows with its lag, exactly over a step.
class Thrusters {
 public:
  /// Throws std::invalid_argument, which begins with `name`: no thrusters, a direction without
  /// length, a limit that is not positive, a lag that is negative, numbers that are not finite.
  Thrusters(const std::string& name, const std::vector<ThrusterConfig>& thrusters);

  /// Holds the command for `wanted`, a wrench about B's origin in its axes, over `dt_s`; what
  /// pushes at the end of it. Does not allocate.
  Vector6 Update(const Vector6& wanted, double dt_s);

  /// Whether the last command was scaled down.
  bool saturated() const { return saturated_; }

  /// Of each thruster now [N].
  const Eigen::VectorXd& thrust_n() const { return thrust_; }

 private:
  std::vector<ThrusterConfig> thrusters_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench_of_;  ///< a newton of each
  Eigen::Matrix<double, Eigen::Dynamic, 6> share_;      ///< its pseudo-inverse
  Eigen::VectorXd command_, thrust_;
  bool saturated_ = false;
};

}  // namespace reckon::sim
