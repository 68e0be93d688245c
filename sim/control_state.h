#pragma once

#include <Eigen/Core>

#include "reckon/models/contact_sample.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"

namespace reckon::sim {

/// What a controller knows of its robot.
struct ControlState {
  models::Pose X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();
  models::EncoderVector joint_angle_rad, joint_rate_rad_s;
  models::FootVector contact;  ///< which feet stand: more than ½
};

}  // namespace reckon::sim
