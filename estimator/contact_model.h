#pragma once

#include <Eigen/Core>

#include "reckon/estimator/error_form.h"
#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/setup.h"
#include "reckon/estimator/velocity_model.h"
#include "reckon/models/leg_kinematics.h"

namespace reckon::estimator {

/// Where a leg's encoders put its foot in I, h = p_BF − p_BI, and the covariance of that in I's
/// axes: σ_q² J Jᵀ of the joints beside σ_f² of what the kinematics leave out.
struct FootReading {
  Eigen::Vector3d h = Eigen::Vector3d::Zero();
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Eigen::Vector3d w_rad_s = Eigen::Vector3d::Zero();  ///< of the foot's link against the body
  Eigen::Vector3d dh_m_s = Eigen::Vector3d::Zero();   ///< ḣ = J q̇, likewise
  Eigen::Matrix3d JJ = Eigen::Matrix3d::Zero();       ///< J Jᵀ [m²]
};

/// Reads a foot; `p_BI` is the IMU's origin in the body. Without rates nothing is said of how it
/// moves. Does not allocate.
FootReading ReadFoot(const models::LegKinematics& leg, const models::EncoderVector& angles,
                     const Eigen::Vector3d& p_BI, const Noise& noise,
                     const models::EncoderVector& rates = {});

/// A foot that stands [Hartley20, forward kinematics]: h = Rᵀ (d − p) + n, in right-invariant
/// coordinates
///     z = R̂ h − (d̂ − p̂),   H = −I at p and +I at d,   N = R̂ N R̂ᵀ.
/// Does not allocate.
Linearisation<3> LinearisedContact(const FootReading& y, Slot foot, const NavigationState& x);

/// Leg odometry: I moves as the point of contact at r = h − l stands, with the lever l = r_f Rᵀ e_z
/// of a round foot and the link's rate ω_F against the body. It is the velocity y = ω_F × l − J q̇
/// at a frame r away (LinearisedVelocity), with N = σ_q̇² J Jᵀ + σ_v² I. Does not allocate.
Linearisation<3> LinearisedLegOdometry(const FootReading& y, double radius_m, const Noise& noise,
                                       const TurnRate& turn, const NavigationState& x);

/// Takes a new foot into a filter, d = p + R h: its error is the position's and that of `y`, and in
/// the forms whose position error does not turn with θ, −[h]× θ (of I) on top. Does not allocate.
template <class Core>
void AddFoot(Core& core, const FootReading& y, Slot foot) {
  const Eigen::Matrix3d& R = core.x().R;
  core.x().At(foot) = core.x().p + R * y.h;
  if constexpr (Core::kForm == ErrorForm::kLeftInvariant) {
    core.P().AddFoot(foot, ToLanes(y.N));
    core.P().AddRow(foot, ToLanes(-Skew(y.h)), kThetaSlot);
  } else {
    core.P().AddFoot(foot, ToLanes(Turned(R, y.N)));
    if constexpr (Core::kForm == ErrorForm::kMultiplicative) {
      core.P().AddRow(foot, ToLanes(-R * Skew(y.h)), kThetaSlot);
    }
  }
}

}  // namespace reckon::estimator
