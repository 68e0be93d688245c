#include "reckon/estimator/pose_model.h"

#include <cmath>
#include <numbers>

namespace reckon::estimator {
namespace {

constexpr double kLeastHorizontal = 0.17;  // sin 10°

double HorizontalSquared(const Eigen::Vector3d& axis) { return axis.head<2>().squaredNorm(); }

}  // namespace

Linearisation<3> LinearisedPosition(const models::PoseSample& y, const models::Pose& X_IS,
                                    double scale, const NavigationState& x) {
  const Eigen::Vector3d q = x.p + x.R * X_IS.p;
  Linearisation<3> m;
  m.z = y.X_WS.p - q;
  m.N = (scale * y.position_sigma_m).cwiseAbs2().asDiagonal();
  m.Block(kThetaSlot, -Skew(q));
  m.Plus(kPositionSlot);
  return m;
}

std::optional<Linearisation<1>> LinearisedYaw(const models::PoseSample& y, const models::Pose& X_IS,
                                              double scale, const NavigationState& x) {
  if (!y.has_orientation) return std::nullopt;
  const Eigen::Vector3d measured = y.X_WS.R.col(0), s = x.R * X_IS.R.col(0);
  const double rho2 = HorizontalSquared(s);
  if (std::min(rho2, HorizontalSquared(measured)) < kLeastHorizontal * kLeastHorizontal) {
    return std::nullopt;
  }
  Linearisation<1> m;
  const double difference = std::atan2(measured.y(), measured.x()) - std::atan2(s.y(), s.x());
  m.z(0) = std::remainder(difference, 2.0 * std::numbers::pi);
  const double sigma = scale * y.orientation_sigma_rad.z();
  m.N(0) = sigma * sigma;
  m.Block(kThetaSlot, Lane(-s.z() * s.x() / rho2, -s.z() * s.y() / rho2, 1.0));
  return m;
}

}  // namespace reckon::estimator
