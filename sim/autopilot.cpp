#include "reckon/sim/autopilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "reckon/sim/attitude.h"

namespace reckon::sim {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Autopilot::Autopilot(const std::string& name, const AutopilotConfig& config) : config_(config) {
  const std::pair<const char*, double> gains[] = {
      {"surge_n_s_m", config.surge_n_s_m},
      {"surge_n_m", config.surge_n_m},
      {"sway_n_s_m", config.sway_n_s_m},
      {"sway_n_m", config.sway_n_m},
      {"heave_n_s_m", config.heave_n_s_m},
      {"heave_n_m", config.heave_n_m},
      {"tilt_n_m_rad", config.tilt_n_m_rad},
      {"tilt_n_m_s", config.tilt_n_m_s},
      {"yaw_n_m_s", config.yaw_n_m_s},
      {"heading_1_s", config.heading_1_s},
      {"max_yaw_rate_rad_s", config.max_yaw_rate_rad_s}};
  for (const auto& [key, gain] : gains) {
    if (gain >= 0.0 && std::isfinite(gain)) continue;
    throw std::invalid_argument(name + ": " + key + " must be zero or positive");
  }
}

Vector6 Autopilot::Update(const Course& course, const models::Pose& X_WB, const Vector6& twist,
                          bool saturated) {
  const double heading = HeadingOf(X_WB.R);
  const Matrix3d R_WH = Eigen::AngleAxisd(heading, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d error = R_WH.transpose() * (course.velocity_m_s - X_WB.R * twist.head<3>());
  const Vector3d p(config_.surge_n_s_m, config_.sway_n_s_m, config_.heave_n_s_m);
  const Vector3d i(config_.surge_n_m, config_.sway_n_m, config_.heave_n_m);
  if (!saturated) integral_n_ += i.cwiseProduct(error) / kRateHz;

  const double pitch = std::asin(std::clamp(-X_WB.R(2, 0), -1.0, 1.0));
  const double roll = std::atan2(X_WB.R(2, 1), X_WB.R(2, 2));
  const double turn = std::remainder(course.heading_rad - heading, 2.0 * std::numbers::pi);
  const double yaw_rate = std::clamp(config_.heading_1_s * turn, -config_.max_yaw_rate_rad_s,
                                     config_.max_yaw_rate_rad_s);
  Vector6 wrench;
  wrench << X_WB.R.transpose() * (R_WH * (p.cwiseProduct(error) + integral_n_)),
      -config_.tilt_n_m_rad * roll - config_.tilt_n_m_s * twist[3],
      -config_.tilt_n_m_rad * pitch - config_.tilt_n_m_s * twist[4],
      config_.yaw_n_m_s * (yaw_rate - twist[5]);
  return wrench;
}

}  // namespace reckon::sim
