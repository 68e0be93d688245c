#include "reckon/estimator/static_initialiser.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What is left of the velocity of a robot that passed all tests.
constexpr double kRestVelocity = 5e-3;  ///< m/s

double LargestSigma(const ErrorCovariance& P, ErrorBlock block) {
  return std::sqrt(P.diagonal().segment<3>(block).maxCoeff());
}

}  // namespace

StaticInitialiser::StaticInitialiser(const Setup& setup, double imu_period_s)
    : setup_(setup), rest_(setup.noise, imu_period_s, setup.gravity_m_s2) {}

void StaticInitialiser::Start(const Prior& prior) {
  prior_ = prior;
  rest_.Restart();
}

StaticInitialiser::Progress StaticInitialiser::Add(const Vector3d& w, const Vector3d& a,
                                                   double dt_s) {
  rest_.Add(w, a, dt_s);
  if (!rest_.CanTell()) return Progress::kWaiting;
  if (rest_.LooksMoving({prior_.gyro_bias_rad_s, prior_.accel_bias_m_s2,
                         LargestSigma(prior_.covariance, kGyroBias),
                         LargestSigma(prior_.covariance, kAccelBias)})) {
    rest_.Restart();
    return Progress::kMoving;
  }
  return rest_.seconds() + 0.5 * dt_s < setup_.initialisation.static_duration_s ? Progress::kWaiting
                                                                                : Progress::kDone;
}

bool StaticInitialiser::AddWheelRate(double rate_rad_s) {
  if (!RestAverage::IsMotion(rate_rad_s)) return true;
  rest_.Restart();
  return false;
}

Matrix3d StaticInitialiser::Rotation() const {
  const Vector3d up_I = rest_.accel() - prior_.accel_bias_m_s2;
  const Vector3d up_W = prior_.X_WB.R * up_I;
  return Eigen::Quaterniond::FromTwoVectors(up_W, Vector3d::UnitZ()) * prior_.X_WB.R;
}

NavigationState StaticInitialiser::State(const Vector3d& p_BI) const {
  NavigationState x;
  x.R = Rotation();
  x.p = prior_.X_WB.p + x.R * p_BI;
  x.gyro_bias = setup_.estimate_gyro_bias ? rest_.gyro() : prior_.gyro_bias_rad_s;
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
  P += (rest_.accel_sigma() * rest_.accel_sigma() / rest_.count()) * N * N.transpose();
  P.diagonal().segment<3>(kVelocity).setConstant(kRestVelocity * kRestVelocity);
  const double walk = setup_.noise.gyro_bias_walk_rad_per_s2_sqrt_hz;
  // The mean of a walk lags its end by a third of what it walked.
  P.diagonal().segment<3>(kGyroBias).setConstant(rest_.gyro_sigma() * rest_.gyro_sigma() /
                                                     rest_.count() +
                                                 walk * walk * rest_.seconds() / 3.0);
  return 0.5 * (P + P.transpose());
}

}  // namespace reckon::estimator
