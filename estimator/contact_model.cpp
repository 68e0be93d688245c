#include "reckon/estimator/contact_model.h"

namespace reckon::estimator {

FootReading ReadFoot(const models::LegKinematics& leg, const models::EncoderVector& angles,
                     const Eigen::Vector3d& p_BI, const Noise& noise,
                     const models::EncoderVector& rates) {
  const models::FootPosition foot = leg.Evaluate(angles);
  FootReading reading;
  reading.h = foot.p_BF - p_BI;
  for (Eigen::Index k = 0; k < foot.J.cols(); ++k) {
    const Eigen::Vector3d column = noise.joint_angle_rad * foot.J.col(k);
    reading.N += column * column.transpose();
  }
  if (rates.size() > 0) reading.w_rad_s = foot.A * leg.Pick(rates);
  reading.N.diagonal().array() += noise.foot_position_m * noise.foot_position_m;
  return reading;
}

[[gnu::flatten]] Linearisation<3> LinearisedContact(const FootReading& y, Slot foot,
                                                    const NavigationState& x) {
  const LaneMatrix R = ToLanes(x.R);
  Linearisation<3> m;
  m.z = ToEigen(R * ToLane(y.h) - (ToLane(x.At(foot)) - ToLane(x.p)));
  Store(Turned(R, ToLanes(y.N)), m.N);
  m.Plus(foot);
  m.Minus(kPositionSlot);
  return m;
}

}  // namespace reckon::estimator
