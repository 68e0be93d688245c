#include "reckon/estimator/static_initialiser.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Samples before the scatter says anything.
constexpr int kFewestSamples = 10;
/// Scatter beyond this many believed sigmas, plus a floor for quantisation and a running engine,
/// is motion.
constexpr double kScatterFactor = 3.0;
constexpr double kGyroFloor = 5e-3;   ///< rad/s
constexpr double kAccelFloor = 5e-2;  ///< m/s²
/// A mean further from what the prior allows than this many sigmas is motion.
constexpr double kPriorSigmas = 6.0;
constexpr double kWheelFloor = 0.02;  ///< rad/s
/// What is left of the velocity of a robot that passed all tests.
constexpr double kRestVelocity = 5e-3;  ///< m/s

/// Sample variance of one axis at most.
double Largest(const Vector3d& squares, int n) { return squares.maxCoeff() / (n - 1); }

double LargestSigma(const ErrorCovariance& P, ErrorBlock block) {
  return std::sqrt(P.diagonal().segment<3>(block).maxCoeff());
}

}  // namespace

StaticInitialiser::StaticInitialiser(const Setup& setup, double imu_period_s)
    : setup_(setup),
      gyro_sigma_(setup.noise.gyro_noise_density_rad_per_s_sqrt_hz / std::sqrt(imu_period_s)),
      accel_sigma_(setup.noise.accel_noise_density_m_per_s2_sqrt_hz / std::sqrt(imu_period_s)) {}

void StaticInitialiser::Start(const Prior& prior) {
  prior_ = prior;
  Restart();
}

void StaticInitialiser::Restart() {
  gyro_ = {};
  accel_ = {};
  count_ = 0;
  seconds_ = 0.0;
}

bool StaticInitialiser::LooksMoving() const {
  const double gyro_limit = kScatterFactor * gyro_sigma_ + kGyroFloor;
  const double accel_limit = kScatterFactor * accel_sigma_ + kAccelFloor;
  if (Largest(gyro_.squares, count_) > gyro_limit * gyro_limit) return true;
  if (Largest(accel_.squares, count_) > accel_limit * accel_limit) return true;
  const double rate = (gyro_.mean - prior_.gyro_bias_rad_s).cwiseAbs().maxCoeff();
  if (rate > kPriorSigmas * LargestSigma(prior_.covariance, kGyroBias) + kGyroFloor) return true;
  const double force = (accel_.mean - prior_.accel_bias_m_s2).norm() - setup_.gravity_m_s2;
  return std::abs(force) > kPriorSigmas * LargestSigma(prior_.covariance, kAccelBias) + kAccelFloor;
}

StaticInitialiser::Progress StaticInitialiser::Add(const Vector3d& w, const Vector3d& a,
                                                   double dt_s) {
  ++count_;
  seconds_ += dt_s;
  gyro_.Add(w, count_);
  accel_.Add(a, count_);
  if (count_ < kFewestSamples) return Progress::kWaiting;
  if (LooksMoving()) {
    Restart();
    return Progress::kMoving;
  }
  return seconds_ + 0.5 * dt_s < setup_.initialisation.static_duration_s ? Progress::kWaiting
                                                                         : Progress::kDone;
}

bool StaticInitialiser::AddWheelRate(double rate_rad_s) {
  if (std::abs(rate_rad_s) <= kWheelFloor) return true;
  Restart();
  return false;
}

Matrix3d StaticInitialiser::Rotation() const {
  const Vector3d up_I = accel_.mean - prior_.accel_bias_m_s2;
  const Vector3d up_W = prior_.X_WB.R * up_I;
  return Eigen::Quaterniond::FromTwoVectors(up_W, Vector3d::UnitZ()) * prior_.X_WB.R;
}

NavigationState StaticInitialiser::State(const Vector3d& p_BI) const {
  NavigationState x;
  x.R = Rotation();
  x.p = prior_.X_WB.p + x.R * p_BI;
  x.gyro_bias = setup_.estimate_gyro_bias ? gyro_.mean : prior_.gyro_bias_rad_s;
  x.accel_bias = prior_.accel_bias_m_s2;
  return x;
}

ErrorCovariance StaticInitialiser::Covariance() const {
  Matrix3d MR;  // θ = E_z θ₀ + M R̂ (ζ_a − n), with E_z what the smallest turn keeps of the prior's
  MR << 0, -1, 0, 1, 0, 0, 0, 0, 0;
  MR *= Rotation() / setup_.gravity_m_s2;
  const Matrix3d E_z = Vector3d::UnitZ() * Vector3d::UnitZ().transpose();
  const Matrix3d p_cross = Skew(prior_.X_WB.p);
  // New errors from the prior's: p̂ stays, so that ξ_p = ξ_p0 + [p̂]× (θ − θ₀).
  ErrorCovariance T = ErrorCovariance::Zero();
  T.block<3, 3>(kTheta, kTheta) = E_z;
  T.block<3, 3>(kTheta, kAccelBias) = MR;
  T.block<3, 3>(kPosition, kTheta) = p_cross * (E_z - Matrix3d::Identity());
  T.block<3, 3>(kPosition, kPosition).setIdentity();
  T.block<3, 3>(kPosition, kAccelBias) = p_cross * MR;
  T.block<3, 3>(kAccelBias, kAccelBias).setIdentity();
  Eigen::Matrix<double, kErrorSize, 3> N = Eigen::Matrix<double, kErrorSize, 3>::Zero();
  N.middleRows<3>(kTheta) = -MR;
  N.middleRows<3>(kPosition) = -p_cross * MR;
  ErrorCovariance P = T * prior_.covariance * T.transpose();
  P += (accel_sigma_ * accel_sigma_ / count_) * N * N.transpose();
  P.diagonal().segment<3>(kVelocity).setConstant(kRestVelocity * kRestVelocity);
  const double walk = setup_.noise.gyro_bias_walk_rad_per_s2_sqrt_hz;
  // The mean of a walk lags its end by a third of what it walked.
  P.diagonal().segment<3>(kGyroBias).setConstant(gyro_sigma_ * gyro_sigma_ / count_ +
                                                 walk * walk * seconds_ / 3.0);
  return 0.5 * (P + P.transpose());
}

}  // namespace reckon::estimator
