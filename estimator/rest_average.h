#pragma once

#include <Eigen/Core>

#include "reckon/estimator/setup.h"

namespace reckon::estimator {

/// What is believed of the biases while a rest is judged: values, and the largest sigma of an axis.
struct BiasBelief {
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero(), accel = Eigen::Vector3d::Zero();
  double gyro_sigma = 0.0, accel_sigma = 0.0;
};

/// The mean of IMU samples in I while the robot may be standing still, and the judgement whether it
/// does: little scatter, a mean rate and a mean force that the biases explain. Smooth motion at
/// constant velocity looks the same; wheels or joints tell the difference. Does not allocate.
class RestAverage {
 public:
  /// `period_s` of the IMU: what its noise means for one sample.
  RestAverage(const Noise& noise, double period_s, double gravity_m_s2);

  void Restart();
  void Add(const Eigen::Vector3d& w, const Eigen::Vector3d& a, double dt_s);

  /// An encoder's rate [rad/s] that is motion.
  static bool IsMotion(double rate_rad_s);

  /// Whether enough samples came to judge, and whether they speak of motion.
  bool CanTell() const;
  bool LooksMoving(const BiasBelief& biases) const;

  int count() const { return count_; }
  double seconds() const { return seconds_; }
  const Eigen::Vector3d& gyro() const { return gyro_.mean; }
  const Eigen::Vector3d& accel() const { return accel_.mean; }

  /// Standard deviations of one sample, as believed.
  double gyro_sigma() const { return gyro_sigma_; }
  double accel_sigma() const { return accel_sigma_; }

 private:
  /// Running mean and sum of squared deviations.
  struct Average {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    void Add(const Eigen::Vector3d& x, int n) {
      const Eigen::Vector3d d = x - mean;
      mean += d / n;
      squares += d.cwiseProduct(x - mean);
    }
  };

  double gyro_sigma_, accel_sigma_, gravity_;
  Average gyro_, accel_;
  int count_ = 0;
  double seconds_ = 0.0;
};

}  // namespace reckon::estimator
