#include "reckon/ground_truth/ate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace reckon::ground_truth {

double RotationAngle(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

AbsoluteErrors AbsoluteError(std::span<const TrackSample> samples, const Similarity& alignment) {
  AbsoluteErrors errors;
  for (auto* list : {&errors.position_m, &errors.orientation_deg, &errors.velocity_m_s}) {
    list->reserve(samples.size());
  }
  for (const TrackSample& sample : samples) {
    const models::Pose aligned = alignment.Apply(sample.X_WB);
    errors.position_m.push_back((sample.X_WB_true.p - aligned.p).norm());
    errors.orientation_deg.push_back(RotationAngle(sample.X_WB_true.R.transpose() * aligned.R) *
                                     180.0 / std::numbers::pi);
    errors.velocity_m_s.push_back(
        (sample.v_WB_true - alignment.ApplyToVelocity(sample.v_WB)).norm());
  }
  return errors;
}

}  // namespace reckon::ground_truth
