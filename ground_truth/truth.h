#pragma once

#include <Eigen/Core>

#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::ground_truth {

/// What really happened at one instant. No estimator's header or source can name this type.
struct Truth {
  models::TimeNs t_ns = 0;
  models::Pose X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();    ///< central difference of p_WB over two steps
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< Log(R_k−1ᵀ R_k+1) / 2h, in B
  bool has_biases = true;  ///< false: the biases are unknown, as in most robots' logs; NaN then
  /// Biases of the primary IMU in the axes of I (the IMU's origin, B's axes): R_BS b_S.
  Eigen::Vector3d gyro_bias_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias_m_s2 = Eigen::Vector3d::Zero();
  models::EncoderVector
      wheel_rate_rad_s;                  ///< true spin, left to right and front to rear as modelled
  models::EncoderVector wheel_slip_m_s;  ///< speed of each contact point over the ground
  models::EncoderVector wheel_load_n;    ///< normal force on each wheel
};

}  // namespace reckon::ground_truth
