#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {

Linearisation<3> LinearisedVelocity(const models::BodyVelocitySample& y, const models::Pose& X_IS,
                                    const TurnRate& turn, const NavigationState& x) {
  const Eigen::Vector3d& r = X_IS.p;
  const Eigen::Matrix3d r_cross = Skew(r);
  Linearisation<3> m;
  m.z = x.R * (X_IS.R * y.v_WS_S - turn.w_rad_s.cross(r)) - x.v;
  m.Plus(kVelocitySlot);
  m.Block(kGyroBiasSlot, x.R * r_cross);
  const Eigen::Matrix3d N_I =
      X_IS.R * y.covariance * X_IS.R.transpose() + turn.variance * r_cross * r_cross.transpose();
  m.N = x.R * N_I * x.R.transpose();
  return m;
}

}  // namespace reckon::estimator
