#include "reckon/estimator/gyro_filter.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "estimator/draws.h"
#include "estimator/reference.h"
#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::Real;
using testing_estimator::TimeNs;

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr double kDt = 5e-3;

TEST(Stage, ASecondImuHalvesTheNoise) {
  GyroFilterStage stage({.white = 1e-4, .walk = 0.0, .difference = 1e-2});
  stage.Start();
  stage.Advance({0.1, 0.2, 0.3}, kDt);
  EXPECT_EQ(stage.rate(), Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(stage.white_variance(), 1e-4);
  stage.Correct(1, 0.4, 1e-4);
  EXPECT_LT((stage.rate() - Vector3d(0.1, 0.3, 0.3)).norm(), 1e-15) << "the mean of both";
  EXPECT_DOUBLE_EQ(stage.white_variance(1), 0.5e-4);
  EXPECT_EQ(stage.white_variance(0), 1e-4);
  stage.Advance({0, 0, 0}, kDt);
  EXPECT_EQ(stage.rate(), Vector3d(0, 0, 0)) << "noise lives for one sample";
  EXPECT_EQ(stage.white_variance(1), 1e-4);
}

TEST(Stage, WeighsAWorseImuLess) {
  GyroFilterStage stage({.white = 1e-4, .walk = 0.0, .difference = 1e-2});
  stage.Start();
  stage.Advance({0, 0, 0}, kDt);
  stage.Correct(0, 0.4, 3e-4);
  EXPECT_DOUBLE_EQ(stage.rate().x(), 0.1);
  EXPECT_DOUBLE_EQ(stage.white_variance(0), 0.75e-4) << "1/(1/1 + 1/3)";
}

TEST(Stage, LearnsHowFarTheBiasesLieApart) {
  GyroFilterStage stage({.white = 1e-4, .walk = 0.0, .difference = 1e-2});
  Draws draws(62);
  stage.Start();
  for (int k = 0; k < 1000; ++k) {
    stage.Advance({0.02 + 0.01 * draws.Normal(), 0, 0}, kDt);
    stage.Correct(0, 0.08 + 0.01 * draws.Normal(), 1e-4);
  }
  // 1,000 differences of variance 2e-4; the rate holds the mean bias, 0.03 beside that of α.
  const double sigma = std::sqrt(2e-4 / 1000);
  EXPECT_NEAR(-stage.bias_of_first().x(), 0.03, 0.5 * 5 * sigma);
  stage.Advance({0.02, 0, 0}, kDt);
  const auto [z, S] = stage.Expect(0, 0.08, 1e-4);
  EXPECT_NEAR(z, 0.0, 5 * sigma);
  EXPECT_NEAR(S, 2e-4, 1e-6);
}

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr double kWhite = 1e-4, kWalk = 2e-3, kPriorVariance = 1e-3, kWheelVariance = 3e-4;

/// The yaw axis as one large Gaussian, without recursion: unknowns b_k and n_k of all samples, all
/// yaw rates of the wheels (of every other sample) at once.
struct Batch {
  Batch(const std::vector<double>& alpha, const std::vector<double>& wheels) {
    const auto n = static_cast<Eigen::Index>(alpha.size());
    Matrix P = Matrix::Zero(2 * n, 2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      P(n + i, n + i) = kWhite;
      // The bias walks after each sample: at the first it is still the prior's.
      for (Eigen::Index j = 0; j < n; ++j) {
        P(i, j) = kPriorVariance + kWalk * kWalk * kDt * static_cast<Real>(std::min(i, j));
      }
    }
    Matrix H = Matrix::Zero(n / 2, 2 * n);
    Vector z(n / 2);
    for (Eigen::Index k = 0; k < n / 2; ++k) {
      H(k, 2 * k + 1) = H(k, n + 2 * k + 1) = -1;
      z[k] = static_cast<Real>(wheels[2 * k + 1]) - alpha[2 * k + 1];
    }
    const Matrix S = H * P * H.transpose() + kWheelVariance * Matrix::Identity(n / 2, n / 2);
    const Matrix K = P * H.transpose() * S.inverse();
    bias = static_cast<double>(K.row(n - 1) * z);
    variance = static_cast<double>(P(n - 1, n - 1) - K.row(n - 1) * H * P.col(n - 1));
    variance += kWalk * kWalk * kDt;  // the walk of the last sample
  }
  double bias, variance;
};

TEST(GyroFilter, TheYawBiasIsTheBestLinearEstimateOfAllReadingsTogether) {
  auto setup = testing_estimator::TestSetup();
  setup.suite.sensors[testing_estimator::kImu].X_BS.R.setIdentity();
  setup.gyro_filter.source = "wheels";
  setup.gate.action = GateAction::kOff;
  Noise& noise = setup.noise;
  noise.gyro_noise_density_rad_per_s_sqrt_hz = std::sqrt(kWhite * kDt);
  noise.gyro_bias_walk_rad_per_s2_sqrt_hz = kWalk;
  noise.wheel_yaw_rate_rad_per_s = std::sqrt(kWheelVariance);
  // Their velocity says nothing here.
  noise.wheel_forward_m_per_s = noise.wheel_lateral_m_per_s = noise.wheel_vertical_m_per_s = 1e6;
  Prior prior = testing_estimator::TestPrior();
  prior.covariance.diagonal().segment<3>(kGyroBias).setConstant(kPriorVariance);
  auto filter = Make("inekf", setup, prior);
  Draws draws(61);
  std::vector<double> alpha, wheels;
  for (int k = 0; k < 40; ++k) {
    const TimeNs t = (k + 1) * 5 * kMs;
    const double rate = std::sin(0.3 * k);
    alpha.push_back(rate + 0.02 + 0.01 * draws.Normal());
    wheels.push_back(rate + 0.017 * draws.Normal());
    Measurement imu = testing_estimator::RestingImu(t);
    std::get<models::ImuSample>(imu.sample).gyro_rad_s = {0, 0, alpha.back()};
    std::get<models::ImuSample>(imu.sample).accel_m_s2 = {0, 0, setup.gravity_m_s2};
    (void)filter->Process(imu);
    if (k % 2 == 0) continue;
    const double turn = 0.5 / 0.2 * wheels.back();  // ρ (ω_r − ω_l)/track of 0.2 m and 1 m
    (void)filter->Process(testing_estimator::WheelsAt(t, -turn, turn));
  }
  const Batch batch(alpha, wheels);
  const Estimate e = *filter->Belief();
  // Wheels of a sigma of 1e6 m/s still say a little.
  EXPECT_NEAR(e.gyro_bias_rad_s.z(), batch.bias, 1e-9);
  EXPECT_NEAR(e.covariance(kGyroBias + 2, kGyroBias + 2), batch.variance, 1e-9 * batch.variance);
}

/// A robot on level ground with a cheap gyroscope (0.02 rad/s of turn-on bias), whose wheels roll.
class CheapDrive {
 public:
  CheapDrive(const Setup& setup, std::uint64_t seed, double bias_sigma)
      : setup_(setup), draws_(seed), bias_(draws_.Vector(bias_sigma)) {}

  std::vector<Measurement> Advance(bool wheels) {
    const double t = models::Seconds(t_ns_) + 0.5 * kDt;
    const double yaw_rate = 0.4 * std::sin(0.5 * t);
    t_ns_ += 5 * kMs;
    yaw_ += yaw_rate * kDt;
    const models::Pose& X_BI = setup_.suite.sensors[testing_estimator::kImu].X_BS;
    const Vector3d w(0, 0, yaw_rate);
    const Noise& n = setup_.noise;
    const auto gyro = [&](const Vector3d& bias) {
      return Vector3d(w + bias +
                      draws_.Vector(n.gyro_noise_density_rad_per_s_sqrt_hz / std::sqrt(kDt)));
    };
    // The origin of the IMU turns with the body, which itself stays where it is.
    const Vector3d up = w.cross(w.cross(X_BI.p)) + Vector3d(0, 0, setup_.gravity_m_s2) +
                        Vector3d(0, 0, 0.2 * std::cos(0.5 * t)).cross(X_BI.p);
    models::ImuSample sample;
    sample.interval_ns = 5 * kMs;
    sample.gyro_rad_s = X_BI.R.transpose() * gyro(bias_);
    sample.accel_m_s2 =
        X_BI.R.transpose() *
        (up + draws_.Vector(n.accel_noise_density_m_per_s2_sqrt_hz / std::sqrt(kDt)));
    std::vector<Measurement> all{{testing_estimator::kImu, t_ns_, t_ns_, sample}};
    sample.gyro_rad_s = gyro(-0.5 * bias_.reverse());
    all.push_back({testing_estimator::kSecondImu, t_ns_, t_ns_, sample});
    if (!wheels) return all;
    // Each side turns against the other: ρ (ω_r − ω_l) / track with ρ = 0.2 m and 1 m.
    const double turn =
        0.5 / 0.2 * (yaw_rate + setup_.noise.wheel_yaw_rate_rad_per_s * draws_.Normal());
    all.push_back(testing_estimator::WheelsAt(t_ns_, -turn, turn));
    return all;
  }

  double yaw() const { return yaw_; }
  const Vector3d& bias() const { return bias_; }

 private:
  Setup setup_;
  Draws draws_;
  Vector3d bias_;
  double yaw_ = 0.0;
  TimeNs t_ns_ = 0;
};

Setup CheapSetup(const std::string& source) {
  Setup setup = testing_estimator::TestSetup();
  setup.suite.sensors[testing_estimator::kImu].X_BS.R.setIdentity();
  setup.noise.gyro_noise_density_rad_per_s_sqrt_hz = 2e-3;
  setup.noise.gyro_bias_walk_rad_per_s2_sqrt_hz = 0.0;
  setup.noise.wheel_yaw_rate_rad_per_s = 0.03;
  setup.gyro_filter.source = source;
  return setup;
}

/// Squared yaw errors after `seconds`, and their mean as the filter sees it.
struct YawErrors {
  double squared = 0.0, believed = 0.0, nees = 0.0;
};

YawErrors RunCheap(const char* type, const std::string& source, double bias_sigma, double seconds,
                   int runs) {
  YawErrors errors;
  Setup setup = CheapSetup(source);
  setup.gyro_filter.bias_sigma_rad_s = bias_sigma;
  for (int seed = 1; seed <= runs; ++seed) {
    CheapDrive drive(setup, static_cast<std::uint64_t>(seed), bias_sigma);
    Prior prior = testing_estimator::TestPrior();
    prior.covariance.diagonal().head<3>().setConstant(1e-8);
    prior.covariance.diagonal().segment<3>(kGyroBias).setConstant(bias_sigma * bias_sigma);
    auto filter = Make(type, setup, prior);
    for (int i = 1; i <= static_cast<int>(seconds / kDt); ++i) {
      for (const Measurement& m : drive.Advance(i % 4 == 0)) {
        const Report report = filter->Process(m);
        EXPECT_TRUE(report.refusal == Refusal::kNone || report.refusal == Refusal::kUnused);
      }
    }
    const Estimate e = *filter->Belief();
    const double error = Log(e.X_WB.R * Exp({0, 0, drive.yaw()}).transpose()).z();
    const double variance = ConvertForm(e.covariance, e.form, ErrorForm::kRightInvariant,
                                        testing_estimator::StateOf(e))(2, 2);
    errors.squared += error * error / runs;
    errors.believed += variance / runs;
    errors.nees += error * error / variance / runs;
  }
  return errors;
}

TEST(GyroFilter, WheelsTakeTheYawBiasFromAnyFilter) {
  for (const char* type : {"inekf", "mekf"}) {
    const YawErrors without = RunCheap(type, "", 0.02, 20.0, 20);
    const YawErrors with = RunCheap(type, "wheels", 0.02, 20.0, 20);
    // A lateral speed of the wheels of 3 cm/s over the IMU's lever arm of 0.2 m tells a little of
    // the bias; their difference, 3 cm/s too over 1 m, tells five times as much.
    EXPECT_LT(with.squared, 0.25 * without.squared) << type;
    // The mean of 20 squared normals is below 2.9 but for 1e-6.
    EXPECT_LT(with.nees, 2.9) << type;
    EXPECT_GT(with.nees, 0.2) << type;
  }
}

TEST(GyroFilter, ASecondImuHalvesTheNoiseOfTheYaw) {
  const int runs = 60;
  const YawErrors one = RunCheap("inekf", "", 1e-6, 10.0, runs);
  const YawErrors two = RunCheap("inekf", "spare_imu", 1e-6, 10.0, runs);
  EXPECT_NEAR(one.believed, 4e-6 * 10, 0.02 * one.believed) << "density² times time";
  EXPECT_NEAR(two.believed / one.believed, 0.5, 0.02);
  // Mean of 60 squared normals: 1 ± 5 √(2/60).
  EXPECT_NEAR(one.nees, 1.0, 0.92);
  EXPECT_NEAR(two.nees, 1.0, 0.92);
}

TEST(GyroFilter, ReportsWhatTheSecondSourceSaid) {
  const auto setup = CheapSetup("wheels");
  CheapDrive drive(setup, 3, 0.001);
  auto filter = Make("inekf", setup);
  for (const Measurement& m : drive.Advance(true)) {
    const Report report = filter->Process(m);
    if (m.sensor != testing_estimator::kWheels) continue;
    ASSERT_EQ(report.corrections().size(), 2u) << "yaw rate and velocity";
    EXPECT_EQ(report.corrections()[0].rows, 1);
    EXPECT_EQ(report.corrections()[0].sensor, testing_estimator::kWheels);
    EXPECT_EQ(report.corrections()[1].rows, 3);
  }
}

TEST(GyroFilter, RefusesSourcesThatAreNone) {
  for (const char* source : {"imu", "velocity", "nobody"}) {
    EXPECT_THROW(Make("inekf", CheapSetup(source)), std::invalid_argument) << source;
  }
  auto blind = CheapSetup("wheels");
  blind.noise.wheel_yaw_rate_rad_per_s = 0.0;
  EXPECT_THROW(Make("inekf", blind), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::estimator
