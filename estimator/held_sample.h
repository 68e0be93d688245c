#pragma once

#include <Eigen/Core>

#include "reckon/estimator/navigation_state.h"
#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// A motion nobody saw: one sigma of a constant acceleration beside the held sample.
inline constexpr double kUnseenAcceleration = 3.0;  ///< m/s²

/// The IMU sample that moves a filter. What no sample covers is bridged: the sample is held over
/// it, as if an unknown constant motion of 0.5 rad/s and 3 m/s² (one sigma) came on top. Does not
/// allocate.
class HeldSample {
 public:
  /// Nothing is held, and nothing unseen before `t_ns`.
  void Start(models::TimeNs t_ns);

  /// Takes the sample that ends at `valid_ns`, for a state of `t_ns`; `R_IS` turns it into I.
  void Take(models::TimeNs t_ns, models::TimeNs valid_ns, const models::ImuSample& sample,
            const Eigen::Matrix3d& R_IS);

  /// Nothing was seen from one time to the other.
  void Coast(models::TimeNs from_ns, models::TimeNs to_ns);

  /// The noise at a time of one whose white noise is `seen` where the sample covers it; more where
  /// it does not, and where the sample is saturated.
  ProcessNoise NoiseAt(models::TimeNs t_ns, const ProcessNoise& seen) const;

  /// Before this nothing was seen.
  models::TimeNs covered_from_ns() const { return covered_from_ns_; }

  double seconds() const { return seconds_; }            ///< its length
  const Eigen::Vector3d& gyro() const { return gyro_; }  ///< in I, bias and all
  const Eigen::Vector3d& accel() const { return accel_; }
  void set_gyro(const Eigen::Vector3d& w) { gyro_ = w; }

 private:
  Eigen::Vector3d gyro_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_ = Eigen::Vector3d::Zero();
  double seconds_ = 0.0;
  models::TimeNs covered_from_ns_ = 0;
  double unseen_s_ = 0.0;
  bool gyro_saturated_ = false, accel_saturated_ = false;
};

}  // namespace reckon::estimator
