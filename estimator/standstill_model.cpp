#include "reckon/estimator/standstill_model.h"

namespace reckon::estimator {

Linearisation<3> LinearisedZeroVelocity(double sigma_m_s, const NavigationState& x) {
  Linearisation<3> m;
  m.z = -x.v;
  m.N.diagonal().setConstant(sigma_m_s * sigma_m_s);
  m.Plus(kVelocitySlot);
  return m;
}

Linearisation<3> LinearisedZeroRate(const Eigen::Vector3d& w, double variance,
                                    const NavigationState& x) {
  Linearisation<3> m;
  m.z = w - x.gyro_bias;
  m.N.diagonal().setConstant(variance);
  m.Plus(kGyroBiasSlot);
  return m;
}

}  // namespace reckon::estimator
