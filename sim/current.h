#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "reckon/sim/hydrodynamics.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/range.h"

namespace reckon::sim {

/// How the water flows: the same everywhere, and without rotation.
struct CurrentConfig {
  Eigen::Vector3d mean_m_s = Eigen::Vector3d::Zero();  ///< in W
  double sigma_m_s = 0.0;  ///< stationary, of each axis of a Gauss-Markov process on top
  double time_constant_s = 300.0;

  static constexpr Range kSpeed{-10, 10}, kSigma{0, 10}, kTimeConstant = AboveUpTo(0, 1e6);
};

/// The current of a run: the mean and, on each axis, x_{k+1} = φ x_k + σ √(1 − φ²) n with
/// φ = e^(−Δ/τ), drawn every Δ = 1 s from its stationary distribution on and joined by cubic
/// Hermite splines with central slopes, so that the acceleration is continuous. Draws come from
/// "current", channel = axis, index = second + 1.
class Current {
 public:
  /// Throws std::invalid_argument for numbers out of range.
  Current(const CurrentConfig& config, std::uint64_t seed);

  /// At `t_s` ≥ 0 after the run's start; time must not go back by more than a second. Does not
  /// allocate.
  WaterMotion At(double t_s);

 private:
  void NextKnot();

  CurrentConfig config_;
  RandomStream draws_;
  double kept_;                             ///< φ
  std::array<Eigen::Vector3d, 4> knots_{};  ///< at the seconds second_ − 1 … second_ + 2
  long long second_ = 0;
  std::uint64_t drawn_ = 0;
};

}  // namespace reckon::sim
