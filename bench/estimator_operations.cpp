#include "estimator_operations.h"

#include "reckon/estimator/kalman.h"

namespace reckon::bench {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using estimator::KalmanCorrection;
using estimator::Linearisation;
using estimator::Slot;
using estimator::SlotVector;

namespace {

const Vector3d kGravity(0, 0, -9.81);
const Vector3d kGyro(0.1, -0.2, 0.3);
const Vector3d kAccel(0.3, 0.2, 9.8);
constexpr double kStep = 0.0025;
constexpr double kGyroVariance = 1e-6;
constexpr double kDepth = -1.9;
constexpr double kDepthSigma = 0.01;
const estimator::ProcessNoise kNoise{2.5e-9, 4e-8, 1e-10, 1e-8};
const Vector3d kMounting(0.2, -0.05, 0.1);  ///< of sensors and of the body's origin, in I
const Matrix3d kFootNoise = Vector3d(1e-4, 2e-4, 1e-4).asDiagonal();

/// Correlated, as after some driving.
estimator::ErrorCovariance StartCovariance() {
  Eigen::Matrix<double, 15, 1> sigma;
  sigma << 0.02, 0.02, 0.1, 0.05, 0.05, 0.05, 1, 1, 1, 1e-3, 1e-3, 1e-3, 0.02, 0.02, 0.02;
  estimator::ErrorCovariance correlation = estimator::ErrorCovariance::Identity();
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < i; ++j) correlation(i, j) = correlation(j, i) = 0.2 / (i - j + 1);
  }
  return sigma.asDiagonal() * correlation * sigma.asDiagonal();
}

/// y = e_zᵀ p: h = (p_y, −p_x, 0) at θ and e_z at p.
Linearisation<1> LinearisedDepth(double y, double sigma, const estimator::NavigationState& x) {
  Linearisation<1> m;
  m.z(0) = y - x.p.z();
  m.N(0) = sigma * sigma;
  m.Block(estimator::kThetaSlot, Eigen::RowVector3d(x.p.y(), -x.p.x(), 0.0));
  m.Block(estimator::kPositionSlot, Eigen::RowVector3d(0.0, 0.0, 1.0));
  return m;
}

/// Rᵀ (d − p) = h + n: −I at p, +I at d.
Linearisation<3> LinearisedFoot(const Vector3d& h, const Matrix3d& N, Slot foot,
                                const estimator::NavigationState& x) {
  Linearisation<3> m;
  m.z = x.R * h - (x.At(foot) - x.p);
  m.N = estimator::Turned(x.R, N);
  m.Minus(estimator::kPositionSlot);
  m.Plus(foot);
  return m;
}

}  // namespace

EstimatorOperations::EstimatorOperations(int feet) {
  estimator::NavigationState x;
  x.R = estimator::Exp({0.1, -0.2, 1.0});
  x.v = {1.0, 0.5, -0.1};
  x.p = {10.0, -5.0, -2.0};
  core_.Start(x, StartCovariance());
  for (int i = 0; i < feet; ++i) {
    foot_in_I_[i] = {i < 2 ? 0.25 : -0.25, i % 2 == 0 ? 0.15 : -0.15, -0.3};
    const Slot slot = estimator::FootSlot(i);
    core_.P().AddFoot(slot, estimator::ToLanes(kFootNoise));
    core_.x().At(slot) = x.p + x.R * foot_in_I_[i];
  }
  velocity_.v_WS_S = {1.1, 0.0, 0.0};
  velocity_.covariance = Vector3d(1e-4, 2e-4, 4e-4).asDiagonal();
  X_IS_ = {estimator::Exp({0.0, 0.0, 0.5}), kMounting};
}

void EstimatorOperations::Predict() {
  const auto& x = core_.x();
  core_.Propagate({kGyro - x.gyro_bias, kAccel - x.accel_bias, kStep}, kGravity, kNoise);
}

void EstimatorOperations::CorrectVelocity() {
  const estimator::TurnRate turn{kGyro - core_.x().gyro_bias, kGyroVariance};
  const auto m = LinearisedVelocity(velocity_, X_IS_, turn, core_.x());
  const KalmanCorrection<3> kalman(core_.P(), core_.Convert(m, core_.x()));
  core_.Retract(kalman.Gain());
  kalman.UpdateCovariance(core_.P());
}

void EstimatorOperations::CorrectDepth() {
  const auto m = LinearisedDepth(kDepth, kDepthSigma, core_.x());
  const KalmanCorrection<1> kalman(core_.P(), core_.Convert(m, core_.x()));
  core_.Retract(kalman.Gain());
  kalman.UpdateCovariance(core_.P());
}

void EstimatorOperations::CorrectFeet() {
  SlotVector sum{};
  for (const Slot foot : core_.P().slots().feet()) {
    auto m =
        LinearisedFoot(foot_in_I_[foot - estimator::kFirstFootSlot], kFootNoise, foot, core_.x());
    m.MoveBy(sum);
    const KalmanCorrection<3> kalman(core_.P(), m);
    const SlotVector increment = kalman.Gain();
    for (const Slot slot : core_.P().active()) sum[slot] += increment[slot];
    kalman.UpdateCovariance(core_.P());
  }
  core_.Retract(sum);
}

void EstimatorOperations::AddAndRemoveFoot() {
  const Slot foot = estimator::FootSlot(0);
  core_.P().AddFoot(foot, estimator::ToLanes(kFootNoise));
  core_.x().At(foot) = core_.x().p + core_.x().R * Vector3d(0.25, 0.15, -0.3);
  core_.P().RemoveFoot(foot);
}

void EstimatorOperations::BodyCovariance() {
  body_ = core_.BodyCovariance(kMounting, kGyro, kGyroVariance);
}

const std::vector<Operation>& AllOperations() {
  using E = EstimatorOperations;
  static const std::vector<Operation> kAll{
      {"predict, 15 states", 0, &E::Predict},
      {"predict, 4 feet (27)", 4, &E::Predict},
      {"velocity, 15 states", 0, &E::CorrectVelocity},
      {"depth, 15 states", 0, &E::CorrectDepth},
      {"4 feet in sequence (27)", 4, &E::CorrectFeet},
      {"add and remove a foot", 0, &E::AddAndRemoveFoot},
      {"body covariance, 15 states", 0, &E::BodyCovariance},
  };
  return kAll;
}

}  // namespace reckon::bench
