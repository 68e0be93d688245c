#pragma once

#include "reckon/estimator/estimator.h"
#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {

/// Planar odometry from wheel encoders alone: speed ρ(ω_l + ω_r)/2 and yaw rate ρ(ω_r − ω_l)/track,
/// each mean held since the last sample (for no more than `kLongestGap`). Height and tilt stay the
/// prior's. It has no covariance.
class WheelOdometry final : public Estimator {
 public:
  /// Throws std::invalid_argument for what CheckDrive refuses and a track that is not positive.
  explicit WheelOdometry(const Setup& setup);

  void Start(const Prior& prior) override;
  Report Process(const models::Measurement& measurement) override;
  std::optional<Estimate> Belief() const override;

 private:
  void Move(models::TimeNs to_ns, const models::EncoderSample& sample, Report& report);

  models::Suite suite_;
  models::WheelDrive drive_;
  bool started_ = false;
  models::TimeNs t_ns_ = 0;
  models::Pose X_WB_;
  Eigen::Vector3d v_WB_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::estimator
