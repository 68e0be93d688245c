#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "reckon/models/contact_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::estimator {

/// How an estimator measures its own error; the covariance is of these coordinates.
/// Hats are estimates; R, v, p are those of the body B in W; ζ = b̂ − b for both biases.
enum class ErrorForm : std::uint8_t {
  kRightInvariant,  ///< ξ = Log(X̂ X⁻¹): θ = Log(R̂Rᵀ), ξ_v = J⁻¹(θ)(v̂ − R̂Rᵀ v), likewise p
  kLeftInvariant,  ///< ξ = Log(X⁻¹ X̂), in body axes
  kMultiplicative,  ///< θ = Log(Rᵀ R̂) in body axes; v̂ − v and p̂ − p in W (the classical MEKF)
};

/// Order of the 15 error coordinates, three each: orientation, velocity, position, gyroscope bias,
/// accelerometer bias.
enum ErrorBlock : int { kTheta = 0, kVelocity = 3, kPosition = 6, kGyroBias = 9, kAccelBias = 12 };
inline constexpr int kErrorSize = 15;

using ErrorVector = Eigen::Matrix<double, kErrorSize, 1>;
using ErrorCovariance = Eigen::Matrix<double, kErrorSize, kErrorSize>;

/// What an estimator believes of the body at one instant. SI units, W unless named otherwise.
struct Estimate {
  models::TimeNs t_ns = 0;
  models::Pose X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias_rad_s = Eigen::Vector3d::Zero();  ///< in the axes of I (B's axes)
  Eigen::Vector3d accel_bias_m_s2 = Eigen::Vector3d::Zero();  ///< in the axes of I (B's axes)
  ErrorForm form = ErrorForm::kRightInvariant;
  bool has_covariance = false;  ///< plain odometry has none; then `covariance` is zero
  bool has_biases = false;      ///< plain odometry estimates none
  ErrorCovariance covariance = ErrorCovariance::Zero();
  models::FootVector contact;  ///< the probability that each foot stands; empty: it does not say
};

}  // namespace reckon::estimator
