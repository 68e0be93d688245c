#include "reckon/estimator/depth_model.h"

#include "reckon/estimator/height_model.h"

namespace reckon::estimator {

Linearisation<1> LinearisedDepth(const models::DepthSample& y, const Eigen::Vector3d& r,
                                 double sigma_m, const NavigationState& x) {
  return LinearisedHeight(-y.depth_m, sigma_m, kPositionSlot, x.p + x.R * r);
}

}  // namespace reckon::estimator
