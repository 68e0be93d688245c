#include "reckon/sim/thrusters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

void Check(const std::string& name, const ThrusterConfig& thruster) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(name + ": a thruster's " + what);
  };
  require(thruster.p_BT_m.allFinite(), "place must be finite");
  require(thruster.direction.allFinite() && thruster.direction.norm() > 1e-6,
          "direction must have a length");
  require(std::isfinite(thruster.limit_n) && thruster.limit_n > 0.0, "limit_n must be positive");
  require(std::isfinite(thruster.lag_s) && thruster.lag_s >= 0.0, "lag_s must not be negative");
}

}  // namespace

Thrusters::Thrusters(const std::string& name, const std::vector<ThrusterConfig>& thrusters)
    : thrusters_(thrusters) {
  if (thrusters.empty()) throw std::invalid_argument(name + ": there are no thrusters");
  const auto count = static_cast<Eigen::Index>(thrusters.size());
  wrench_of_.resize(6, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ThrusterConfig& thruster = thrusters[static_cast<std::size_t>(i)];
    Check(name, thruster);
    const Vector3d direction = thruster.direction.normalized();
    wrench_of_.col(i) << direction, thruster.p_BT_m.cross(direction);
  }
  share_ = wrench_of_.completeOrthogonalDecomposition().pseudoInverse();
  command_ = thrust_ = Eigen::VectorXd::Zero(count);
}

Vector6 Thrusters::Update(const Vector6& wanted, double dt_s) {
  command_.noalias() = share_ * wanted;
  double excess = 1.0;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    const double asked = std::abs(command_[static_cast<Eigen::Index>(i)]);
    excess = std::max(excess, asked / thrusters_[i].limit_n);
  }
  saturated_ = excess > 1.0;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double lag_s = thrusters_[i].lag_s;
    const double reached = lag_s > 0.0 ? -std::expm1(-dt_s / lag_s) : 1.0;
    thrust_[at] += reached * (command_[at] / excess - thrust_[at]);
  }
  return wrench_of_ * thrust_;
}

}  // namespace reckon::sim
