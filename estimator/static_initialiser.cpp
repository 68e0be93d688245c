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

void StaticInitialiser::AddWheelRate(double rate_rad_s) {
  if (std::abs(rate_rad_s) > kWheelFloor) Restart();
}

Matrix3d StaticInitialiser::Rotation() const {
  // The tilt that turns the mean specific force upwards, after the prior's yaw.
  const Vector3d up_I = (accel_.mean - prior_.accel_bias_m_s2).normalized();
  const Matrix3d level =
      Eigen::Quaterniond::FromTwoVectors(up_I, Vector3d::UnitZ()).toRotationMatrix();
  const auto yaw = [](const Matrix3d& R) { return std::atan2(R(1, 0), R(0, 0)); };
  return Exp(Vector3d(0, 0, yaw(prior_.X_WB.R) - yaw(level))) * level;
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
  ErrorCovariance P = ErrorCovariance::Zero();
  const Matrix3d R = Rotation();
  Matrix3d M;  // θ = M R̂ (ζ_a − n), its yaw aside
  M << 0, -1, 0, 1, 0, 0, 0, 0, 0;
  M /= setup_.gravity_m_s2;
  const Matrix3d P_a = prior_.covariance.block<3, 3>(kAccelBias, kAccelBias);
  const double n_a = accel_sigma_ * accel_sigma_ / count_;
  const Matrix3d MR = M * R;
  P.block<3, 3>(kTheta, kTheta) = MR * (P_a + n_a * Matrix3d::Identity()) * MR.transpose();
  P(kTheta + 2, kTheta + 2) = prior_.covariance(kTheta + 2, kTheta + 2);
  P.block<3, 3>(kTheta, kAccelBias) = MR * P_a;
  P.block<3, 3>(kAccelBias, kTheta) = P_a * MR.transpose();
  P.block<3, 3>(kAccelBias, kAccelBias) = P_a;
  P.diagonal().segment<3>(kVelocity).setConstant(kRestVelocity * kRestVelocity);
  P.block<3, 3>(kPosition, kPosition) = prior_.covariance.block<3, 3>(kPosition, kPosition);
  const double walk = setup_.noise.gyro_bias_walk_rad_per_s2_sqrt_hz;
  // The mean of a walk lags its end by a third of what it walked.
  P.diagonal().segment<3>(kGyroBias).setConstant(gyro_sigma_ * gyro_sigma_ / count_ +
                                                 walk * walk * seconds_ / 3.0);
  return P;
}

}  // namespace reckon::estimator
