#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <unsupported/Eigen/MatrixFunctions>

#include "reckon/sim/imu.h"
#include "sim/analytic_motion.h"

// What is left of an error-free IMU when its samples are integrated again. The propagation is
// written out here, with its Γ from a generic matrix exponential: nothing is shared with what it
// tests.
namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using models::ImuSample;
using testing_sim::RoughRide;
using testing_sim::SlantedMounting;
using testing_sim::WindowAt;

constexpr models::TimeNs kMs = 1'000'000;
constexpr double kGravity = 9.81;

struct Gammas {
  Matrix3d zero, one, two;
};

/// Γ0, Γ1, Γ2 are the top row of exp([φ I 0; 0 0 I; 0 0 0]), by blocks of three.
Gammas GammasOf(const Vector3d& phi) {
  Matrix3d K;
  K << 0, -phi.z(), phi.y(), phi.z(), 0, -phi.x(), -phi.y(), phi.x(), 0;
  Eigen::Matrix<double, 9, 9> A = Eigen::Matrix<double, 9, 9>::Zero();
  A.block<3, 3>(0, 0) = K;
  A.block<3, 3>(0, 3).setIdentity();
  A.block<3, 3>(3, 6).setIdentity();
  const Eigen::Matrix<double, 9, 9> E = A.exp();
  return {E.block<3, 3>(0, 0), E.block<3, 3>(0, 3), E.block<3, 3>(0, 6)};
}

/// Rotation, velocity and position of the sensor in W.
struct State {
  Matrix3d R;
  Vector3d v, p;
};

State TrueState(const MotionWindow& motion, const models::Pose& X_BS) {
  return {motion.X_WB.R * X_BS.R, motion.Velocity(X_BS.p), motion.X_WB * X_BS.p};
}

State Propagate(const State& x, const ImuSample& sample, double gravity_m_s2) {
  const double dt = models::Seconds(sample.interval_ns);
  const Vector3d g(0, 0, -gravity_m_s2), a = sample.accel_m_s2;
  const Gammas gamma = GammasOf(sample.gyro_rad_s * dt);
  return {x.R * gamma.zero, x.v + x.R * gamma.one * a * dt + g * dt,
          x.p + x.v * dt + x.R * gamma.two * a * dt * dt + 0.5 * g * dt * dt};
}

/// Largest errors over a ride.
struct Floor {
  double attitude_rad = 0.0, velocity_m_s = 0.0, position_m = 0.0;
};

struct Experiment {
  ImuConfig config;
  models::Pose X_BS = SlantedMounting();           ///< where the sensor is
  models::Pose X_BS_believed = SlantedMounting();  ///< where the integration starts it
  double gravity_m_s2 = kGravity;                  ///< what the integration believes
  std::function<void(ImuSample&)> spoil = [](ImuSample&) {};
  models::TimeNs duration_ns = 60'000 * kMs;
};

Floor Integrate(const Experiment& experiment) {
  Imu imu("imu", 0, experiment.X_BS, experiment.config, 1, kMs, kGravity);
  const RoughRide ride;
  State x = TrueState(WindowAt(ride, 0, kMs), experiment.X_BS_believed);
  Floor floor;
  std::vector<models::Measurement> out;
  for (models::TimeNs t = 0; t <= experiment.duration_ns; t += kMs) {
    const MotionWindow motion = WindowAt(ride, t, kMs);
    out.clear();
    imu.Observe(motion, out);
    if (out.empty()) continue;
    ImuSample sample = std::get<ImuSample>(out[0].sample);
    experiment.spoil(sample);
    x = Propagate(x, sample, experiment.gravity_m_s2);
    const State truth = TrueState(motion, experiment.X_BS);
    // |R̂ᵀR − I|_F = √8 sin(angle/2) → √2 angle.
    const double attitude =
        (x.R.transpose() * truth.R - Matrix3d::Identity()).norm() / std::sqrt(2);
    floor.attitude_rad = std::max(floor.attitude_rad, attitude);
    floor.velocity_m_s = std::max(floor.velocity_m_s, (x.v - truth.v).norm());
    floor.position_m = std::max(floor.position_m, (x.p - truth.p).norm());
  }
  return floor;
}

Experiment At(double rate_hz) {
  Experiment experiment;
  experiment.config.timing.rate_hz = rate_hz;
  return experiment;
}

// R comes back to round-off, which adds up to √60000 · 1e-16 = 3e-14 at 1 kHz; v too, to that tilt
// times g times 60 s = 2e-11. In p an interval misses what the change of the specific force within
// it adds, ≈ dt²/12 times its change over the ride (some m/s²): 2e-5 · 3 / 12 = 6 µm at 200 Hz.
TEST(ImuFloor, IncrementsReproduceAttitudeAndVelocityToRoundOff) {
  const Floor fast = Integrate(At(1000.0));
  EXPECT_LT(fast.attitude_rad, 1e-12);
  EXPECT_LT(fast.velocity_m_s, 4e-11);
  EXPECT_LT(fast.position_m, 2e-6);
  const Floor usual = Integrate(At(200.0));
  EXPECT_LT(usual.attitude_rad, 1e-12);
  EXPECT_LT(usual.velocity_m_s, 2e-11);
  EXPECT_LT(usual.position_m, 20e-6);
  RecordProperty("position_floor_200_hz_nm", static_cast<int>(usual.position_m * 1e9));
  EXPECT_LT(Integrate(At(100.0)).position_m, 100e-6);
}

TEST(ImuFloor, PointSamplesAreFarWorse) {
  Experiment experiment = At(200.0);
  experiment.config.mode = ImuMode::kPoint;
  const Floor floor = Integrate(experiment);
  EXPECT_GT(floor.position_m, 0.01);
  EXPECT_GT(floor.attitude_rad, 1e-6);
}

// Controls: each mistake that the floor is there to find lies far above it.

TEST(ImuFloor, SeesAMissingGamma1) {
  Experiment experiment = At(200.0);
  experiment.spoil = [](ImuSample& s) {
    s.accel_m_s2 = GammasOf(s.gyro_rad_s * models::Seconds(s.interval_ns)).one * s.accel_m_s2;
  };
  EXPECT_GT(Integrate(experiment).position_m, 0.01);
}

TEST(ImuFloor, SeesGravitysSign) {
  Experiment experiment = At(200.0);
  experiment.gravity_m_s2 = -kGravity;
  EXPECT_GT(Integrate(experiment).position_m, 1000.0);
}

TEST(ImuFloor, SeesGravityInTheThirdDigit) {
  Experiment experiment = At(200.0);
  experiment.gravity_m_s2 = 9.80665;
  EXPECT_GT(Integrate(experiment).position_m, 1.0);
}

TEST(ImuFloor, SeesAWrongLeverArm) {
  Experiment experiment = At(200.0);
  experiment.X_BS_believed.p.setZero();
  EXPECT_GT(Integrate(experiment).position_m, 0.1);
}

TEST(ImuFloor, SeesAWrongMounting) {
  Experiment experiment = At(200.0);
  experiment.X_BS_believed.R.transposeInPlace();
  EXPECT_GT(Integrate(experiment).attitude_rad, 0.1);
}

TEST(ImuFloor, SeesAStampThatIsOneSampleLate) {
  Experiment experiment = At(200.0);
  ImuSample held;
  held.accel_m_s2 = SlantedMounting().R.transpose() * Vector3d(0, 0, kGravity);
  held.interval_ns = 5 * kMs;
  experiment.spoil = [held](ImuSample& s) mutable { std::swap(held, s); };
  EXPECT_GT(Integrate(experiment).position_m, 1e-3);
}

// A filtered unit turns late, but it integrates: the attitude lags by delay times rate and stays
// there.
TEST(ImuFloor, BandwidthDelaysTheAttitudeAndDoesNotLetItDrift) {
  Experiment experiment = At(200.0);
  experiment.config.bandwidth_hz = 100.0;
  experiment.config.bandwidth_poles = 1;
  const Floor whole = Integrate(experiment);
  experiment.duration_ns = 10'000 * kMs;
  const Floor tenth = Integrate(experiment);
  // Delay 1/(2π · 100 Hz) = 1.6 ms at rates of up to about 1 rad/s.
  EXPECT_GT(tenth.attitude_rad, 0.5e-3);
  EXPECT_LT(whole.attitude_rad, 3e-3);
  EXPECT_LT(whole.attitude_rad, 2.0 * tenth.attitude_rad);
}

}  // namespace
}  // namespace reckon::sim
