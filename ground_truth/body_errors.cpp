#include "reckon/ground_truth/body_errors.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace reckon::ground_truth {

BodyErrors BodyError(std::span<const TrackSample> samples) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  BodyErrors errors;
  for (const TrackSample& sample : samples) {
    const Eigen::Matrix3d R_true_T = sample.X_WB_true.R.transpose();
    const Eigen::Matrix3d R_T = sample.X_WB.R.transpose();
    const Eigen::Vector3d up_true = R_true_T.col(2), up = R_T.col(2);
    errors.tilt_deg.push_back(kDegrees * std::atan2(up.cross(up_true).norm(), up.dot(up_true)));
    const Eigen::Quaterniond turn(sample.X_WB.R * R_true_T);
    const double half = std::atan2(std::abs(turn.z()), std::abs(turn.w()));
    errors.heading_deg.push_back(kDegrees * 2.0 * half);
    errors.velocity_m_s.push_back((R_T * sample.v_WB - R_true_T * sample.v_WB_true).norm());
  }
  return errors;
}

}  // namespace reckon::ground_truth
