#include "reckon/estimator/standing_feet.h"

#include <Eigen/Geometry>

namespace reckon::estimator {

void StandingFeet::Hear(const models::ContactSample& y) {
  constexpr double kStands = 0.5;
  for (Eigen::Index i = 0; i < y.probability.size(); ++i) {
    stands_[i] = y.probability[i] > kStands;
  }
}

StandingFeet::Readings StandingFeet::Read(const models::EncoderSample& y,
                                          const FilterBeliefs& beliefs) {
  const auto& legs = beliefs.setup.suite.legs->legs;
  Readings readings;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!stands_[i]) continue;
    readings[i] = ReadFoot(legs[i], y.angle_rad, beliefs.p_BI, beliefs.setup.noise, y.rate_rad_s);
    link_rate_.col(static_cast<Eigen::Index>(i)) = readings[i].w_rad_s;
  }
  return readings;
}

RollingFeet StandingFeet::Rolling(const Eigen::Vector3d& w_rad_s, const NavigationState& x,
                                  double radius_m) const {
  RollingFeet rolling;
  const Eigen::Vector3d lever = radius_m * x.R.row(2).transpose();
  for (Eigen::Index i = 0; i < kMaxFeet; ++i) {
    if (!stands_[i]) continue;
    rolling.lever.col(i) = lever;
    rolling.u.col(i) = (w_rad_s + link_rate_.col(i)).cross(lever);
  }
  return rolling;
}

}  // namespace reckon::estimator
