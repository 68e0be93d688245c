#pragma once

#include <Eigen/Core>

namespace reckon::sim {

/// A low-pass of three axes with unit gain at rest and −3 dB at the cutoff: one real pole, or two
/// poles of a Butterworth filter.
///
/// ẏ = −ω y + ω u, or ÿ = −√2 ω ẏ − ω² y + ω² u, with ω = 2π · cutoff. The input is held over a
/// step, and the step is the exact solution z⁺ = e^{Ah} (z − (u, 0)) + (u, 0) with z = (y, ẏ/ω).
/// The first input finds the filter settled at it.
class LowPass {
 public:
  LowPass(double cutoff_hz, int poles, double step_s);

  /// The output at the end of a step over which the input was `u`.
  Eigen::Vector3d Step(const Eigen::Vector3d& u);

 private:
  Eigen::Matrix2d Phi_;
  Eigen::Matrix<double, 3, 2> z_;
  bool started_ = false;
};

}  // namespace reckon::sim
