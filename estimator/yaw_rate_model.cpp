#include "reckon/estimator/yaw_rate_model.h"

namespace reckon::estimator {

Linearisation<1> LinearisedYawRate(double y_rad_s, double w_z, double variance,
                                   const NavigationState& x) {
  Linearisation<1> m;
  m.z(0) = y_rad_s - (w_z - x.gyro_bias.z());
  m.N(0) = variance;
  m.Block(kGyroBiasSlot, Lane(0.0, 0.0, -1.0));
  return m;
}

}  // namespace reckon::estimator
