#include "reckon/estimator/gyro_filter.h"

namespace reckon::estimator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

GyroFilterStage::GyroFilterStage(const GyroFilterNoise& noise) : noise_(noise) {}

void GyroFilterStage::Start(const Vector3d& bias, double variance) {
  for (int i = 0; i < 3; ++i) {
    axes_[i].x = {bias[i], 0.0, 0.0};
    axes_[i].P = Vector3d(variance, noise_.white, noise_.second_imu_bias).asDiagonal();
  }
}

void GyroFilterStage::Advance(const Vector3d& alpha, double dt_s) {
  alpha_ = alpha;
  for (Axis& axis : axes_) {
    axis.x[1] = 0.0;
    axis.P.row(1).setZero();
    axis.P.col(1).setZero();
    axis.P(1, 1) = noise_.white;
    axis.P(0, 0) += noise_.walk * dt_s;
    axis.P(2, 2) += noise_.walk * dt_s;
  }
}

GyroFilterStage::Innovation GyroFilterStage::Expect(int i, double beta, double variance,
                                          bool from_imu) const {
  const Vector3d H = Row(from_imu);
  return {beta - alpha_[i] - H.dot(axes_[i].x), H.dot(axes_[i].P * H) + variance};
}

void GyroFilterStage::Correct(int i, const Innovation& innovation, bool from_imu) {
  Axis& axis = axes_[i];
  const Vector3d H = Row(from_imu), K = axis.P * H / innovation.S;
  const double R = innovation.S - H.dot(axis.P * H);
  axis.x += K * innovation.z;
  const Matrix3d A = Matrix3d::Identity() - K * H.transpose();
  axis.P = A * axis.P * A.transpose() + R * K * K.transpose();
}

Vector3d GyroFilterStage::rate() const {
  Vector3d rate = alpha_;
  for (int i = 0; i < 3; ++i) rate[i] -= axes_[i].x[0] + axes_[i].x[1];
  return rate;
}

Vector3d GyroFilterStage::bias() const { return {axes_[0].x[0], axes_[1].x[0], axes_[2].x[0]}; }

Vector3d GyroFilterStage::bias_variance() const {
  return {axes_[0].P(0, 0), axes_[1].P(0, 0), axes_[2].P(0, 0)};
}

Vector3d GyroFilterStage::white_variance() const {
  return {axes_[0].P(1, 1), axes_[1].P(1, 1), axes_[2].P(1, 1)};
}

}  // namespace reckon::estimator
