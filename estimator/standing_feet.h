#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/filter_beliefs.h"
#include "reckon/estimator/leg_load.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/body_velocity_sample.h"
#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// Which feet stand, by the sensor that the filter was told to believe, and how their legs moved
/// when the encoders spoke last. Nothing allocates.
class StandingFeet {
 public:
  using Readings = std::array<FootReading, kMaxFeet>;

  /// How I moves: its turn rate and specific force, less the biases, and its attitude.
  struct Motion {
    Eigen::Vector3d w_rad_s, a_m_s2;
    Eigen::Matrix3d R_WI;
  };

  /// None stands.
  void Start() { *this = {}; }

  /// A foot that is more probably in contact than not stands.
  void Hear(const models::ContactSample& y);

  /// Keeps what the legs' encoders say.
  void Hear(const models::EncoderSample& y) { joints_ = y; }

  /// Weighs the feet by the motors' torques (LegLoad), at the encoders' newest angles: the upward
  /// part of the force decides. Nothing happens before the encoders have spoken.
  void Weigh(models::TimeNs t_ns, const models::TorqueSample& y, const Motion& motion,
             const FilterBeliefs& beliefs);

  /// Weighs them by the forces that sensors in them feel.
  void Weigh(models::TimeNs t_ns, const models::FootForceSample& y, const FilterBeliefs& beliefs);

  bool Stands(std::size_t foot) const { return probability_[foot] > kStands; }

  /// The probability that each of the first `feet` stands.
  models::FootVector Probabilities(std::size_t feet) const;

  /// Reads the feet that stand.
  Readings Read(const models::EncoderSample& y, const FilterBeliefs& beliefs);

  /// How they roll on level ground [Bloesch12: the contact point stands] while I turns with
  /// `w_rad_s`: ω = w + the link's rate, l = r Rᵀ e_z. For feet of radius r > 0 that are taken for
  /// round.
  RollingFeet Rolling(const Eigen::Vector3d& w_rad_s, const NavigationState& x,
                      double radius_m) const;

 private:
  static constexpr double kStands = 0.5;

  void Judge(std::size_t foot, double force_n, double dt_s, const ContactDetection& told);

  std::array<double, kMaxFeet> probability_{};
  RollingFeet::Columns link_rate_ = RollingFeet::Columns::Zero();  ///< in B
  models::EncoderSample joints_;                                   ///< the newest
  std::array<LegLoad, kMaxFeet> loads_;
  std::array<double, kMaxFeet> force_n_{};  ///< through its low-pass
  models::TimeNs weighed_ns_ = -1;          ///< when; −1: never
};

}  // namespace reckon::estimator
