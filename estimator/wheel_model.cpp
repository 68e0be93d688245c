#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {
namespace {

std::optional<double> Mean(const models::EncoderVector& rate, const std::vector<int>& entries) {
  double sum = 0.0;
  for (const int entry : entries) {
    if (entry >= rate.size()) return std::nullopt;
    sum += rate[entry];
  }
  return sum / static_cast<double>(entries.size());
}

}  // namespace

std::optional<SideRates> MeanRates(const models::EncoderSample& sample,
                                   const models::WheelDrive& drive) {
  const auto left = Mean(sample.rate_rad_s, drive.left);
  const auto right = Mean(sample.rate_rad_s, drive.right);
  if (!left || !right) return std::nullopt;
  return SideRates{*left, *right};
}

models::BodyVelocitySample WheelVelocity(const SideRates& rates, const models::WheelDrive& drive,
                                         const Noise& noise) {
  models::BodyVelocitySample velocity;
  velocity.v_WS_S.x() = drive.rolling_radius_m * 0.5 * (rates.left + rates.right);
  const Eigen::Vector3d sigma(noise.wheel_forward_m_per_s, noise.wheel_lateral_m_per_s,
                              noise.wheel_vertical_m_per_s);
  velocity.covariance = sigma.cwiseAbs2().asDiagonal();
  return velocity;
}

double WheelYawRate(const SideRates& rates, const models::WheelDrive& drive) {
  return drive.rolling_radius_m * (rates.right - rates.left) / drive.effective_track_m;
}

}  // namespace reckon::estimator
