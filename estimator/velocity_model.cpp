#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {

[[gnu::flatten]] Linearisation<3> LinearisedVelocity(const models::BodyVelocitySample& y,
                                                     const models::Pose& X_IS, const TurnRate& turn,
                                                     const NavigationState& x) {
  const LaneMatrix R = ToLanes(x.R);
  const LaneMatrix R_WS = R * ToLanes(X_IS.R);
  const Lane r = ToLane(X_IS.p);
  LaneMatrix N = Turned(R_WS, ToLanes(y.covariance));
  Lane v_W = R_WS * ToLane(y.v_WS_S);
  Linearisation<3> m;
  m.Plus(kVelocitySlot);
  if (Dot(r, r) > 0.0) {
    const LaneMatrix R_r_cross = R * DiagonalAndCross(0.0, r);
    v_W -= R * Cross(ToLane(turn.w_rad_s), r);
    AddTimesTransposed(N, turn.variance * R_r_cross, R_r_cross);
    m.Block(kGyroBiasSlot, R_r_cross);
  }
  m.z = ToEigen(v_W - ToLane(x.v));
  Store(N, m.N);
  return m;
}

}  // namespace reckon::estimator
