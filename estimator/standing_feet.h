#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/filter_beliefs.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/contact_sample.h"

namespace reckon::estimator {

/// Which feet stand, and how their links turned when the encoders spoke last. Nothing allocates.
class StandingFeet {
 public:
  using Readings = std::array<FootReading, kMaxFeet>;

  /// None stands.
  void Start() { *this = {}; }

  /// A foot that is more probably in contact than not stands.
  void Hear(const models::ContactSample& y);

  bool Stands(std::size_t foot) const { return stands_[foot]; }

  /// Reads the feet that stand.
  Readings Read(const models::EncoderSample& y, const FilterBeliefs& beliefs);

  /// How they roll on level ground [Bloesch12: the contact point stands] while I turns with
  /// `w_rad_s`: ω = w + the link's rate, l = r Rᵀ e_z. For feet of radius r > 0 that are taken for
  /// round.
  RollingFeet Rolling(const Eigen::Vector3d& w_rad_s, const NavigationState& x,
                      double radius_m) const;

 private:
  std::array<bool, kMaxFeet> stands_{};
  RollingFeet::Columns link_rate_ = RollingFeet::Columns::Zero();  ///< in B
};

}  // namespace reckon::estimator
