#include "reckon/estimator/height_model.h"

namespace reckon::estimator {

Linearisation<1> LinearisedHeight(double y_m, double sigma_m, Slot slot, const Eigen::Vector3d& q) {
  Linearisation<1> m;
  m.z(0) = y_m - q.z();
  m.N(0) = sigma_m * sigma_m;
  m.Block(kThetaSlot, Lane(q.y(), -q.x(), 0.0));
  m.Block(slot, Lane(0.0, 0.0, 1.0));
  return m;
}

}  // namespace reckon::estimator
