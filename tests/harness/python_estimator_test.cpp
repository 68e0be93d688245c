// The worked example examples/python_estimator/dead_reckoning.py against drives whose course is
// known in closed form.

#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reckon/harness/process_estimator.h"

namespace reckon::harness {
namespace {

using Eigen::Vector3d;
using models::Pose;
using models::TimeNs;

constexpr double kGravity = 9.81;
constexpr double kRadius = 0.165;
constexpr TimeNs kImuPeriod = 10'000'000, kWheelPeriod = 20'000'000;

Eigen::Matrix3d Skew(const Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

/// A drive on flat ground: the wheels' frame moves along its own x axis at `speed(t)`, whose
/// integral is `distance(t)`, and turns at the constant rate `turn`.
struct Drive {
  double turn;
  std::function<double(double)> speed, distance;
};

/// Speeds up at 0.5 m/s² for 2 s, then keeps 1 m/s, in a straight line.
Drive Straight() {
  return {0.0, [](double t) { return t < 2.0 ? 0.5 * t : 1.0; },
          [](double t) { return t < 2.0 ? 0.25 * t * t : t - 1.0; }};
}

/// 1 m/s around a circle of radius 2 m.
Drive Circle() {
  return {0.5, [](double) { return 1.0; }, [](double t) { return t; }};
}

/// No frame coincides with another: the IMU is turned and away from the body, the wheels too.
estimator::Setup TurnedSetup() {
  estimator::Setup setup;
  const Eigen::AngleAxisd R_BS(2.5, Vector3d(1, 2, -1).normalized());
  setup.suite.sensors = {
      {"imu", models::SensorKind::kImu, {R_BS.toRotationMatrix(), {0.2, -0.1, 0.3}}, kImuPeriod},
      {"encoders", models::SensorKind::kEncoders, {}, kWheelPeriod}};
  setup.suite.wheels = {"encoders", {0}, {1},
                        kRadius,    0.6, {Eigen::Matrix3d::Identity(), {-0.1, 0.0, -0.2}}};
  setup.noise = {.gyro_noise_density_rad_per_s_sqrt_hz = 1e-4,
                 .accel_noise_density_m_per_s2_sqrt_hz = 1e-3,
                 .gyro_bias_walk_rad_per_s2_sqrt_hz = 1e-6,
                 .accel_bias_walk_m_per_s3_sqrt_hz = 1e-5,
                 .wheel_forward_m_per_s = 0.02,
                 .wheel_lateral_m_per_s = 0.02,
                 .wheel_vertical_m_per_s = 0.02};
  setup.gravity_m_s2 = kGravity;
  return setup;
}

struct Motion {
  Pose X_WB;
  Vector3d v_WB, w_WB_B;
};

Motion At(const Drive& drive, double t, const estimator::Setup& setup) {
  const double yaw = 0.7 + drive.turn * t;
  Motion motion;
  motion.w_WB_B = {0, 0, drive.turn};
  motion.X_WB.R = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d heading = motion.X_WB.R.col(0);
  // The wheels' frame first; the body hangs on it.
  const Vector3d& p_BS = setup.suite.wheels->X_BS.p;
  const Vector3d p_WS =
      drive.turn == 0.0 ? Vector3d(drive.distance(t) * heading)
                        : Vector3d(std::sin(yaw) / drive.turn, -std::cos(yaw) / drive.turn, 0.0);
  motion.X_WB.p = p_WS - motion.X_WB.R * p_BS;
  motion.v_WB = drive.speed(t) * heading - motion.X_WB.R * motion.w_WB_B.cross(p_BS);
  return motion;
}

/// The sample that a perfect unit reports over (t − Δt, t], as `ImuSample` defines it.
models::Measurement Imu(const Drive& drive, TimeNs t_ns, const estimator::Setup& setup,
                        const Vector3d& gyro_bias_B, const Vector3d& accel_bias_B) {
  const Pose& X_BS = setup.suite.sensors[0].X_BS;
  const double dt = models::Seconds(kImuPeriod);
  const Motion i = At(drive, models::Seconds(t_ns - kImuPeriod), setup);
  const Motion j = At(drive, models::Seconds(t_ns), setup);
  const Vector3d v_i = i.v_WB + i.X_WB.R * i.w_WB_B.cross(X_BS.p);
  const Vector3d v_j = j.v_WB + j.X_WB.R * j.w_WB_B.cross(X_BS.p);
  const Eigen::Matrix3d R_WS = i.X_WB.R * X_BS.R;
  const Vector3d angle = X_BS.R.transpose() * i.w_WB_B * dt;
  Eigen::Matrix3d gamma1 = Eigen::Matrix3d::Zero(), power = Eigen::Matrix3d::Identity();
  for (int n = 0; n < 8; ++n) {  // |angle| is 0.005: the ninth term is below 1e-24
    gamma1 += power / std::tgamma(n + 2.0);
    power = power * Skew(angle);
  }
  const Vector3d dv = R_WS.transpose() * (v_j - v_i + Vector3d(0, 0, kGravity * dt));
  return {0, t_ns, t_ns,
          models::ImuSample{angle / dt + X_BS.R.transpose() * gyro_bias_B,
                            gamma1.inverse() * dv / dt + X_BS.R.transpose() * accel_bias_B,
                            kImuPeriod, false, false}};
}

models::Measurement Wheels(const Drive& drive, TimeNs t_ns) {
  // The two sides differ on a turn; only their mean tells the forward speed.
  const double rate = drive.speed(models::Seconds(t_ns)) / kRadius, difference = drive.turn;
  models::EncoderSample sample;
  sample.rate_rad_s = Eigen::Vector2d(rate - difference, rate + difference);
  sample.angle_rad = Eigen::Vector2d::Zero();
  sample.interval_ns = kWheelPeriod;
  return {1, t_ns, t_ns, sample};
}

ProcessEstimator Example(const estimator::Setup& setup) {
  return ProcessEstimator({"example",
                           {"python3", "dead_reckoning.py"},
                           std::filesystem::path(RECKON_SOURCE_DIR) / "examples/python_estimator",
                           20.0,
                           "test"},
                          setup);
}

estimator::Prior PriorAtTruth(const Drive& drive, const estimator::Setup& setup, double sigma) {
  const Motion start = At(drive, 0.0, setup);
  estimator::Prior prior;
  prior.X_WB = start.X_WB;
  prior.v_WB = start.v_WB;
  prior.w_WB_B = start.w_WB_B;
  prior.covariance = sigma * sigma * estimator::ErrorCovariance::Identity();
  return prior;
}

struct Aid {
  bool wheels = true;
  Vector3d gyro_bias = Vector3d::Zero(), accel_bias = Vector3d::Zero();  // in B's axes
};

estimator::Estimate After(double seconds, const Drive& drive, const estimator::Setup& setup,
                          const estimator::Prior& prior, const Aid& aid) {
  ProcessEstimator example = Example(setup);
  example.Start(prior);
  const auto end = static_cast<TimeNs>(seconds * 1e9);
  for (TimeNs t_ns = kImuPeriod; t_ns <= end; t_ns += kImuPeriod) {
    // The wheels' message comes first: the example must wait for the IMU to get there.
    if (aid.wheels && t_ns % kWheelPeriod == 0) (void)example.Process(Wheels(drive, t_ns));
    (void)example.Process(Imu(drive, t_ns, setup, aid.gyro_bias, aid.accel_bias));
  }
  return example.Belief().value();
}

double AngleBetween(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  return Eigen::AngleAxisd(A.transpose() * B).angle();
}

class PerfectSensors : public testing::TestWithParam<bool> {};

TEST_P(PerfectSensors, FollowTheAnalyticCourse) {
  const Drive drive = GetParam() ? Circle() : Straight();
  const estimator::Setup setup = TurnedSetup();
  const auto belief = After(10.0, drive, setup, PriorAtTruth(drive, setup, 1e-3), {});
  const Motion truth = At(drive, 10.0, setup);
  EXPECT_EQ(belief.t_ns, 10'000'000'000);
  // Both drives are exact solutions of the recursion: what is left is rounding over 1000 steps.
  EXPECT_LT((belief.X_WB.p - truth.X_WB.p).norm(), 1e-8);
  EXPECT_LT((belief.v_WB - truth.v_WB).norm(), 1e-8);
  EXPECT_LT(AngleBetween(belief.X_WB.R, truth.X_WB.R), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Drives, PerfectSensors, testing::Bool(),
                         [](const auto& test) { return test.param ? "Circle" : "Straight"; });

/// Accelerometer 0.05 m/s² off, velocity 0.2 m/s and pitch 0.01 rad wrong at the start.
estimator::Estimate Disturbed(bool wheels) {
  const estimator::Setup setup = TurnedSetup();
  const Drive drive = Straight();
  estimator::Prior prior = PriorAtTruth(drive, setup, 1e-3);
  prior.v_WB += 0.2 * prior.X_WB.R.col(0);
  prior.X_WB.R = prior.X_WB.R * Eigen::AngleAxisd(0.01, Vector3d::UnitY()).toRotationMatrix();
  const auto believe = [&prior](int block, double sigma) {
    prior.covariance.diagonal().segment<3>(block).setConstant(sigma * sigma);
  };
  believe(estimator::kTheta, 0.02);
  believe(estimator::kVelocity, 0.2);
  believe(estimator::kAccelBias, 0.05);
  return After(10.0, drive, setup, prior, {.wheels = wheels, .accel_bias = {0.05, 0, 0.02}});
}

TEST(PythonExample, WheelsHoldTheDrift) {
  const Motion truth = At(Straight(), 10.0, TurnedSetup());
  const auto aided = Disturbed(true);
  const Vector3d error = aided.X_WB.p - truth.X_WB.p;
  ASSERT_TRUE(aided.has_covariance);
  EXPECT_LT(std::sqrt(aided.covariance(estimator::kVelocity, estimator::kVelocity)), 0.02);
  // Perfect wheels of 0.02 m/s believed noise: well inside of it once the start is forgotten.
  EXPECT_LT((aided.v_WB - truth.v_WB).norm(), 0.01);
  // 0.2 m/s until the first correction, 4 mm; then the wrong 0.15 m/s² until the wheels' speeds
  // show its slope, about 0.4 s, 12 mm.
  EXPECT_LT(error.head<2>().norm(), 0.03);
  // Pitch and accelerometer bias can't be told apart on a straight line: up to 0.05 / 9.81 rad of
  // pitch remain, over 9 m of way.
  EXPECT_LT(std::abs(error.z()), 0.05);

  // Without wheels the velocity alone makes 2 m, bias and tilt ½·0.15·10² = 7 m, in whatever sense.
  const auto unaided = Disturbed(false);
  EXPECT_GT((unaided.X_WB.p - truth.X_WB.p).norm(), 2.0);
}

TEST(PythonExample, RefusesWhatItCannotUseAndGoesOn) {
  estimator::Setup setup = TurnedSetup();
  setup.suite.sensors.push_back({"dvl", models::SensorKind::kBodyVelocity, {}, kWheelPeriod});
  const Drive drive = Circle();
  ProcessEstimator example = Example(setup);
  example.Start(PriorAtTruth(drive, setup, 1e-3));
  auto broken = Imu(drive, kImuPeriod, setup, Vector3d::Zero(), Vector3d::Zero());
  std::get<models::ImuSample>(broken.sample).gyro_rad_s.x() = std::nan("");
  EXPECT_EQ(example.Process(broken).refusal, estimator::Refusal::kNotFinite);
  const auto good = Imu(drive, 2 * kImuPeriod, setup, Vector3d::Zero(), Vector3d::Zero());
  EXPECT_TRUE(example.Process(good).propagated);  // covers the broken sample's time as well
  EXPECT_EQ(example.Process(good).refusal, estimator::Refusal::kBackwards);
  EXPECT_EQ(example.Process({2, kWheelPeriod, kWheelPeriod, models::BodyVelocitySample{}}).refusal,
            estimator::Refusal::kUnused);
  const auto report = example.Process(Wheels(drive, 2 * kImuPeriod));
  ASSERT_EQ(report.corrections().size(), 3u);
  for (const estimator::Correction& correction : report.corrections()) {
    EXPECT_EQ(correction.decision, estimator::Decision::kAccepted);
    EXPECT_LT(correction.nis, 1e-3);  // truth was told: no innovation beside 0.02 m/s
  }
  // A wheel that spins: 1 m/s off, fifty standard deviations.
  auto spinning = Wheels(drive, 2 * kImuPeriod);
  std::get<models::EncoderSample>(spinning.sample).rate_rad_s.array() += 1.0 / kRadius;
  const auto gated = example.Process(spinning);
  ASSERT_EQ(gated.corrections().size(), 3u);
  EXPECT_EQ(gated.corrections()[0].decision, estimator::Decision::kRejected);
  EXPECT_LT((example.Belief()->v_WB - At(drive, 0.02, setup).v_WB).norm(), 1e-6);
}

}  // namespace
}  // namespace reckon::harness
