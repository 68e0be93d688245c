#include "reckon/sim/low_pass.h"

#include <cmath>
#include <numbers>

namespace reckon::sim {

LowPass::LowPass(double cutoff_hz, int poles, double step_s) {
  const double x = 2.0 * std::numbers::pi * cutoff_hz * step_s;
  if (poles == 1) {
    Phi_ << std::exp(-x), 0.0, 0.0, 0.0;
    return;
  }
  // A = ω [0 1; −1 −√2] has the eigenvalues ω(−1 ± i)/√2:
  // e^{Ah} = e^{−r} (cos r I + sin r/r (Ah + r I)), r = ωh/√2.
  const double r = x / std::numbers::sqrt2;
  Eigen::Matrix2d Ah;
  Ah << 0.0, x, -x, -2.0 * r;
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  Phi_ = std::exp(-r) * (std::cos(r) * I + std::sin(r) / r * (Ah + r * I));
}

Eigen::Vector3d LowPass::Step(const Eigen::Vector3d& u) {
  if (!started_) z_ << u, Eigen::Vector3d::Zero();
  started_ = true;
  z_.col(0) -= u;
  z_ = (z_ * Phi_.transpose()).eval();
  z_.col(0) += u;
  return z_.col(0);
}

}  // namespace reckon::sim
