#pragma once

#include <Eigen/Core>

#include "reckon/estimator/setup.h"
#include "reckon/models/leg_dynamics.h"
#include "reckon/models/leg_kinematics.h"

namespace reckon::estimator {

/// What is known of a leg at one instant.
struct LegReading {
  models::LegVector q, dq, torque_n_m;
  models::BodyMotion body;  ///< dw is not known: zero
};

/// The force of the ground on a foot, from the torques of its leg's motors: Jᵀ f is what they lack,
///     static     Jᵀ f = g(q) − τ,
///     inertia    Jᵀ f = M(q) q̈ + h(q, q̇, body) − τ,   q̈ by difference,
///     momentum   Jᵀ f ≈ K (p − p̂),  p = M q̇,  p̂' = τ − h + Ṁ q̇ + K (p − p̂) [DeLuca05],
/// which needs no q̈ and follows Jᵀ f through one pole. Friction in the joints is not known. Nothing
/// allocates.
class LegLoad {
 public:
  /// Nothing was heard yet.
  void Start() { *this = {}; }

  /// The force [N] in B after `dt_s` more; of the first reading that of the static model.
  /// `kinematics` and `dynamics` must be of the same leg.
  Eigen::Vector3d Force(const LegReading& reading, double dt_s, const ContactDetection& told,
                        const models::FootPosition& foot, const models::LegDynamics& dynamics);

 private:
  models::LegVector Lacking(const LegReading& reading, double dt_s, const ContactDetection& told,
                            const models::LegDynamics& dynamics);

  models::LegVector dq_;                  ///< of the reading before; empty before the first
  models::LegDynamics::Matrix M_;         ///< likewise
  models::LegVector momentum_, driving_;  ///< p and τ − h + Ṁ q̇ through the observer's pole
};

}  // namespace reckon::estimator
