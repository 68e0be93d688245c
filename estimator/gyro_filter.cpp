#include "reckon/estimator/gyro_filter.h"

#include <algorithm>

namespace reckon::estimator {

using Eigen::Vector3d;

GyroFilterStage::GyroFilterStage(const GyroFilterNoise& noise) : noise_(noise) {}

void GyroFilterStage::Start() {
  for (Axis& axis : axes_) axis = {.P_n = noise_.white, .P_d = noise_.difference};
}

void GyroFilterStage::Advance(const Vector3d& alpha, double dt_s) {
  alpha_ = alpha;
  for (Axis& axis : axes_) {
    axis.n = 0.0;
    axis.P_n = noise_.white;
    axis.P_d += noise_.walk * dt_s;
    axis.K = 0.0;
  }
}

GyroFilterStage::Innovation GyroFilterStage::Expect(int i, double beta, double variance) const {
  const Axis& axis = axes_[i];
  return {beta - (alpha_[i] - axis.n) - axis.d, axis.P_n + axis.P_d + variance};
}

void GyroFilterStage::Correct(int i, double beta, double variance) {
  Axis& axis = axes_[i];
  const auto [z, S] = Expect(i, beta, variance);
  const double K_d = axis.P_d / S;
  axis.d += K_d * z;
  axis.P_d *= 1.0 - K_d;
  axis.K = axis.P_n / (axis.P_n + variance);
  axis.n -= axis.K * (beta - (alpha_[i] - axis.n));
  axis.P_n *= 1.0 - axis.K;
}

void GyroFilterStage::CorrectNoise(int i, double z, double S) {
  Axis& axis = axes_[i];
  const double K = axis.P_n / S;
  axis.n -= K * z;
  axis.P_n *= 1.0 - K;
}

Vector3d GyroFilterStage::rate() const {
  return alpha_ - Vector3d(axes_[0].n, axes_[1].n, axes_[2].n);
}

Vector3d GyroFilterStage::bias_of_first() const {
  return -Vector3d(axes_[0].K * axes_[0].d, axes_[1].K * axes_[1].d, axes_[2].K * axes_[2].d);
}

double GyroFilterStage::white_variance() const {
  return std::max({axes_[0].P_n, axes_[1].P_n, axes_[2].P_n});
}

}  // namespace reckon::estimator
