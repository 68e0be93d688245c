#pragma once

#include <string>

#include <Eigen/Core>

#include "reckon/models/pose.h"
#include "reckon/sim/hydrodynamics.h"

namespace reckon::sim {

/// Gains of an underwater vehicle's control loops. Forces act in the axes of the heading (forward,
/// left, up), moments in those of the body.
struct AutopilotConfig {
  double surge_n_s_m = 80.0, surge_n_m = 40.0;   ///< on the error of speed, and on its integral
  double sway_n_s_m = 80.0, sway_n_m = 30.0;     ///< likewise to the left
  double heave_n_s_m = 120.0, heave_n_m = 60.0;  ///< likewise upwards
  double tilt_n_m_rad = 8.0, tilt_n_m_s = 3.0;   ///< on roll and pitch, and on their rates
  double yaw_n_m_s = 5.0;                        ///< on the error of the yaw rate
  double heading_1_s = 0.8;                      ///< yaw rate for an error of heading,
  double max_yaw_rate_rad_s = 0.4;               ///< up to this
};

/// What is asked of the vehicle: a velocity over ground in W and a heading.
struct Course {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;
};

/// Holds a course and keeps level, with the true state.
class Autopilot {
 public:
  static constexpr double kRateHz = 50.0;

  /// Throws std::invalid_argument, which begins with `name` and names the key, for gains that are
  /// negative or not finite.
  Autopilot(const std::string& name, const AutopilotConfig& config);

  /// The wrench about B's origin in its axes that is wanted of the thrusters. `twist` is (v, ω) in
  /// B. While `saturated`, integrals stand still. To be called at kRateHz. Does not allocate.
  Vector6 Update(const Course& course, const models::Pose& X_WB, const Vector6& twist,
                 bool saturated);

 private:
  AutopilotConfig config_;
  Eigen::Vector3d integral_n_ = Eigen::Vector3d::Zero();  ///< in the axes of the heading
};

}  // namespace reckon::sim
