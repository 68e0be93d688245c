#include "reckon/estimator/standing_feet.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace reckon::estimator {

void StandingFeet::Hear(const models::ContactSample& y) {
  for (Eigen::Index i = 0; i < y.probability.size(); ++i) probability_[i] = y.probability[i];
}

void StandingFeet::Weigh(models::TimeNs t_ns, const models::TorqueSample& y, const Motion& motion,
                         const FilterBeliefs& beliefs) {
  if (joints_.angle_rad.size() == 0) return;
  const models::LegSet& set = *beliefs.setup.suite.legs;
  const double dt_s = weighed_ns_ < 0 ? 0.0 : models::Seconds(t_ns - weighed_ns_);
  const Eigen::Vector3d& w = motion.w_rad_s;
  const Eigen::Vector3d a_B = motion.a_m_s2 - w.cross(w.cross(beliefs.p_BI));
  const Eigen::Vector3d up = motion.R_WI.row(2);
  for (std::size_t i = 0; i < set.legs.size(); ++i) {
    const models::LegKinematics& leg = set.legs[i];
    const LegReading reading{leg.Pick(joints_.angle_rad),
                             leg.Pick(joints_.rate_rad_s),
                             leg.Pick(y.torque_n_m),
                             {w, Eigen::Vector3d::Zero(), a_B}};
    const Eigen::Vector3d force = loads_[i].Force(reading, dt_s, beliefs.setup.contacts,
                                                  leg.Evaluate(joints_.angle_rad), set.dynamics[i]);
    Judge(i, up.dot(force), dt_s, beliefs.setup.contacts);
  }
  weighed_ns_ = t_ns;
}

void StandingFeet::Weigh(models::TimeNs t_ns, const models::FootForceSample& y,
                         const FilterBeliefs& beliefs) {
  const double dt_s = weighed_ns_ < 0 ? 0.0 : models::Seconds(t_ns - weighed_ns_);
  for (Eigen::Index i = 0; i < y.force_n.size(); ++i) {
    Judge(static_cast<std::size_t>(i), y.force_n[i], dt_s, beliefs.setup.contacts);
  }
  weighed_ns_ = t_ns;
}

void StandingFeet::Judge(std::size_t foot, double force_n, double dt_s,
                         const ContactDetection& told) {
  double& force = force_n_[foot];
  const bool first = weighed_ns_ < 0;
  const double decay = first || told.cutoff_hz == 0.0
                           ? 0.0
                           : std::exp(-2.0 * std::numbers::pi * told.cutoff_hz * dt_s);
  force = force_n + decay * (force - force_n);
  const double beyond = force - (told.threshold_n - (Stands(foot) ? told.hysteresis_n : 0.0));
  probability_[foot] = told.logistic_n > 0.0 ? 1.0 / (1.0 + std::exp(-beyond / told.logistic_n))
                       : beyond > 0.0        ? 1.0
                                             : 0.0;
}

models::FootVector StandingFeet::Probabilities(std::size_t feet) const {
  models::FootVector probabilities(static_cast<Eigen::Index>(feet));
  for (std::size_t i = 0; i < feet; ++i) probabilities[i] = probability_[i];
  return probabilities;
}

StandingFeet::Readings StandingFeet::Read(const models::EncoderSample& y,
                                          const FilterBeliefs& beliefs) {
  const auto& legs = beliefs.setup.suite.legs->legs;
  Readings readings;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!Stands(i)) continue;
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
    if (!Stands(static_cast<std::size_t>(i))) continue;
    rolling.lever.col(i) = lever;
    rolling.u.col(i) = (w_rad_s + link_rate_.col(i)).cross(lever);
  }
  return rolling;
}

}  // namespace reckon::estimator
