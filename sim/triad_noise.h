#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "reckon/sim/random_stream.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// The errors of one triad, in its own axes S:
///     y = Q(sat(M x + G f + b + n)),   M = I + scale + misalignment,   f = specific force,
///     n = (σ_c/√dt) N               white, of the same density at every rate
///     b = b_on + b_w + b_gm         constant within a sample, moved at its end:
///     b_w⁺ = b_w + σ_b √dt N,   b_gm⁺ = φ b_gm + σ_B √(1 − φ²) N,   φ = e^(−dt/τ).
/// b_w starts at zero, b_gm from its stationary distribution N(0, σ_B²).
///
/// Draws come from "<name>.noise", ".bias_walk", ".bias_instability", ".turn_on_bias", ".scale",
/// ".misalignment" and ".g_sensitivity"; channel = axis or matrix entry, index = sample.
class TriadNoise {
 public:
  struct Reading {
    Eigen::Vector3d value;
    bool saturated = false;
  };

  /// `name` is "<sensor>.gyro" or "<sensor>.accel", `dt_s` the sample period. Throws
  /// std::invalid_argument for a negative or non-finite entry, or no positive time constant.
  TriadNoise(const std::string& sensor, const std::string& triad, const TriadErrors& errors,
             double dt_s, std::uint64_t seed);

  /// The reading of the next sample, with the bias as it is; then the bias moves on. Samples are
  /// numbered by the calls. Does not allocate.
  Reading Read(const Eigen::Vector3d& x, const Eigen::Vector3d& f);

  /// b as the next sample will carry it.
  const Eigen::Vector3d& bias() const { return bias_; }

 private:
  void MoveBias();

  double noise_, walk_, instability_, phi_, drive_, range_, resolution_;
  RandomStream noise_draws_, walk_draws_, instability_draws_;
  Eigen::Matrix3d M_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d G_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d turn_on_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d walked_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d drifted_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  std::uint64_t index_ = 0;
};

}  // namespace reckon::sim
