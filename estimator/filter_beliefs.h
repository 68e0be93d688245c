#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "reckon/estimator/gate.h"
#include "reckon/estimator/gyro_filter.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/setup.h"

namespace reckon::estimator {

/// What an IMU filter was told, worked out once: the constants of every step. I has the IMU's
/// origin and the body's axes.
struct FilterBeliefs {
  /// Throws std::invalid_argument if the suite has no IMU or one without a period, for a sensor of
  /// legs or of the gyro filter that it has not, and for what CheckSetup refuses.
  explicit FilterBeliefs(const Setup& told);

  Setup setup;
  InnovationGate gate;
  ProcessNoise noise;
  GyroFilterNoise stage_noise;
  Eigen::Vector3d gravity;
  models::SensorId imu;
  models::TimeNs period_ns;
  Eigen::Matrix3d R_BS_imu;        ///< samples are rotated by it once
  Eigen::Vector3d p_BI;            ///< the IMU's origin in the body
  std::vector<models::Pose> X_IS;  ///< by sensor id; of the wheels' encoders the drive's frame

  /// What a filter of these beliefs could do with a measurement that is not its IMU's: kNone if it
  /// can use it, else why not. Does not allocate.
  Refusal WhyUseless(const models::Measurement& measurement) const;

  /// Of a velocity over ground that `y` tells, in its sensor's axes: the delivered covariance,
  /// scaled, and that of the water if it is relative to it.
  Eigen::Matrix3d CovarianceOf(const models::BodyVelocitySample& y) const;

  /// Over how many of its samples the error of a tilt that a sensor meets is one and the same, as
  /// white noise counts them: twice its correlation time, taken for 10 s, over the period.
  double SamplesOfOneTilt(models::SensorId sensor) const;

  /// The most corrections that one measurement can make.
  int MostCorrections(const models::Measurement& measurement) const;

  std::optional<models::SensorId> wheels, leg_encoders, contacts, gyro_source;
  bool gyro_source_is_imu = false;
  double slip_limit = 0.0;        ///< of a foot's NIS, where that tells slip
  double rolling_radius_m = 0.0;  ///< of feet that are taken for round; 0: they do not roll

 private:
  Refusal WhyNotOfFeet(const models::FootVector& feet) const;
  bool HasAllJoints(const models::EncoderVector& joints) const;
};

}  // namespace reckon::estimator
