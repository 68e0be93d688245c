#pragma once

#include "reckon/ground_truth/truth.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::sim {

/// Three consecutive poses of the body, one physics step apart, around the instant `t_ns`. Sensors
/// and truth are made from poses alone; `next` is the one step of look-ahead that a central
/// difference needs. Joint quantities belong to `t_ns`.
struct MotionWindow {
  models::TimeNs t_ns = 0;
  models::TimeNs step_ns = 0;
  models::Pose X_WB_previous, X_WB, X_WB_next;
  models::EncoderVector joint_angle_rad;  ///< accumulated, in the order of the world's encoders
  models::EncoderVector joint_rate_rad_s;
  models::EncoderVector joint_command_n_m, joint_torque_n_m;  ///< asked for, and given
  ground_truth::FeetTruth feet;
  models::FootVector gait;  ///< 1 for each foot that the gait has down
  Eigen::Vector3d water_velocity_m_s = Eigen::Vector3d::Zero();  ///< around the robot, in W

  /// Velocity in W of the point fixed at `p_BS` in the body: (p_S,k+1 − p_S,k−1) / 2h.
  Eigen::Vector3d Velocity(const Eigen::Vector3d& p_BS) const {
    return (X_WB_next * p_BS - X_WB_previous * p_BS) / (2.0 * models::Seconds(step_ns));
  }
};

}  // namespace reckon::sim
