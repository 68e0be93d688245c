#include "reckon/estimator/contact_model.h"

namespace reckon::estimator {

FootReading ReadFoot(const models::LegKinematics& leg, const models::EncoderVector& angles,
                     const Eigen::Vector3d& p_BI, const Noise& noise,
                     const models::EncoderVector& rates) {
  const models::FootPosition foot = leg.Evaluate(angles);
  FootReading reading;
  reading.h = foot.p_BF - p_BI;
  reading.JJ = foot.J * foot.J.transpose();
  reading.N = noise.joint_angle_rad * noise.joint_angle_rad * reading.JJ;
  if (rates.size() > 0) {
    const models::LegVector own = leg.Pick(rates);
    reading.w_rad_s = foot.A * own;
    reading.dh_m_s = foot.J * own;
  }
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

Linearisation<3> LinearisedLegOdometry(const FootReading& y, double radius_m, const Noise& noise,
                                       const TurnRate& turn, const NavigationState& x) {
  const Eigen::Vector3d lever = radius_m * x.R.row(2).transpose();
  const double rate = noise.joint_rate_rad_per_s, velocity = noise.leg_velocity_m_per_s;
  models::BodyVelocitySample sample;
  sample.v_WS_S = y.w_rad_s.cross(lever) - y.dh_m_s;
  sample.covariance = rate * rate * y.JJ + velocity * velocity * Eigen::Matrix3d::Identity();
  return LinearisedVelocity(sample, {Eigen::Matrix3d::Identity(), y.h - lever}, turn, x);
}

}  // namespace reckon::estimator
