#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/models/contact_sample.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::ground_truth {

/// What a foot does to the ground. Off the ground all is zero but the speed of its centre.
struct FootTruth {
  bool contact = false;  ///< it presses with more than kContactForce
  double normal_n = 0.0, tangential_n = 0.0;
  double slip_m_s = 0.0;    ///< of the contact point over the ground
  double centre_m_s = 0.0;  ///< of the foot's origin in W: a round foot rolls
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the ground under it, in W

  static constexpr double kContactForce = 1.0;  ///< N
};

/// The feet of a robot, in the order of its legs; bounded, so that no step allocates.
struct FeetTruth {
  std::array<FootTruth, models::kMaxFeet> foot;
  int count = 0;
};

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
  FeetTruth feet;
};

}  // namespace reckon::ground_truth
