#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {

[[gnu::flatten]] Linearisation<3> LinearisedVelocity(const models::BodyVelocitySample& y,
                                                     const models::Pose& X_IS, const TurnRate& turn,
                                                     const NavigationState& x) {
  const LaneMatrix R = ToLanes(x.R);
  const LaneMatrix R_WS = R * ToLanes(X_IS.R);
  const Lane r = ToLane(X_IS.p);
  const LaneMatrix R_r_cross = R * DiagonalAndCross(0.0, r);
  Linearisation<3> m;
  m.z = ToEigen(R_WS * ToLane(y.v_WS_S) - R * Cross(ToLane(turn.w_rad_s), r) - ToLane(x.v));
  m.Plus(kVelocitySlot);
  m.Block(kGyroBiasSlot, R_r_cross);
  LaneMatrix N = TimesTransposed(R_WS * ToLanes(y.covariance), R_WS);
  AddTimesTransposed(N, turn.variance * R_r_cross, R_r_cross);
  m.N = ToEigen(N);
  return m;
}

}  // namespace reckon::estimator
