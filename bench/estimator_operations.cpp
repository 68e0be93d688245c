#include "estimator_operations.h"

#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/depth_model.h"
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
const models::DepthSample kDepth{1.9};
constexpr double kDepthSigma = 0.01, kSamplesOfOneTilt = 200.0;
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

}  // namespace

EstimatorOperations::EstimatorOperations(int feet) {
  estimator::NavigationState x;
  x.R = estimator::Exp({0.1, -0.2, 1.0});
  x.v = {1.0, 0.5, -0.1};
  x.p = {10.0, -5.0, -2.0};
  core_.Start(x, StartCovariance());
  for (int i = 0; i < feet; ++i) {
    feet_[i] = {{i < 2 ? 0.25 : -0.25, i % 2 == 0 ? 0.15 : -0.15, -0.3}, kFootNoise};
    const Slot slot = estimator::FootSlot(i);
    core_.P().AddFoot(slot, estimator::ToLanes(kFootNoise));
    core_.x().At(slot) = x.p + x.R * feet_[i].h;
  }
  velocity_.v_WS_S = {1.1, 0.0, 0.0};
  velocity_.covariance = Vector3d(1e-4, 2e-4, 4e-4).asDiagonal();
  X_IS_ = {estimator::Exp({0.0, 0.0, 0.5}), kMounting};
}

estimator::TurnRate EstimatorOperations::Turn() const {
  return {kGyro - core_.x().gyro_bias, kGyroVariance};
}

void EstimatorOperations::Predict() {
  const auto& x = core_.x();
  core_.Propagate({kGyro - x.gyro_bias, kAccel - x.accel_bias, kStep}, kGravity, kNoise);
}

template <int kRows>
void EstimatorOperations::Correct(const Linearisation<kRows>& m) {
  KalmanCorrection<kRows> kalman(core_.P(), core_.Convert(m, core_.x()));
  nis_ = kalman.nis();
  kalman.AddLasting();
  core_.Retract(kalman.Gain());
  kalman.UpdateCovariance(core_.P());
}

void EstimatorOperations::CorrectVelocity() {
  Correct(LinearisedVelocity(velocity_, {X_IS_.R, Vector3d::Zero()}, Turn(), core_.x()));
}

void EstimatorOperations::CorrectVelocityOnLeverArm() {
  Correct(LinearisedVelocity(velocity_, X_IS_, Turn(), core_.x()));
}

void EstimatorOperations::CorrectDepth() {
  auto height = LinearisedDepth(kDepth, kMounting, kDepthSigma, core_.x());
  core_.AddCurvature(kMounting, kSamplesOfOneTilt, height);
  Correct(height);
}

void EstimatorOperations::CorrectFeet() {
  SlotVector sum{};
  for (const Slot foot : core_.P().slots().feet()) {
    auto m = LinearisedContact(feet_[foot - estimator::kFirstFootSlot], foot, core_.x());
    m.MoveBy(sum);
    const KalmanCorrection<3> kalman(core_.P(), m);
    nis_ = kalman.nis();
    kalman.AddGainTo(sum);
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
      {"velocity at the IMU, 15 states", 0, &E::CorrectVelocity},
      {"velocity on a lever arm, 15 states", 0, &E::CorrectVelocityOnLeverArm},
      {"depth, 15 states", 0, &E::CorrectDepth},
      {"4 feet in sequence (27)", 4, &E::CorrectFeet},
      {"add and remove a foot", 0, &E::AddAndRemoveFoot},
      {"body covariance, 15 states", 0, &E::BodyCovariance},
  };
  return kAll;
}

}  // namespace reckon::bench
