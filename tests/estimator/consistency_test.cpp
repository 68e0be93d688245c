#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <functional>

#include "estimator/simulated_drive.h"

namespace reckon::estimator {
namespace {

using testing_estimator::ChiSquareAt;
using testing_estimator::ErrorOf;
using testing_estimator::Make;
using testing_estimator::SimulatedDrive;
using testing_estimator::TestPrior;
using testing_estimator::TestSetup;

constexpr std::array<ErrorBlock, 5> kBlocks{kTheta, kVelocity, kPosition, kGyroBias, kAccelBias};

/// With an IMU whose noise matters within seconds beside the prior and the velocity sensor.
Setup NoisyWorld() {
  Setup setup = TestSetup();
  setup.noise.gyro_noise_density_rad_per_s_sqrt_hz = 5e-3;
  setup.noise.accel_noise_density_m_per_s2_sqrt_hz = 5e-2;
  return setup;
}

struct Sums {
  std::array<double, 5> nees{};
  double all = 0.0;  ///< of all 15 coordinates
  double nis = 0.0;
  int corrections = 0;
  int runs = 0;
};

/// NEES after `seconds` and NIS on the way, summed over seeded runs. `sigma` is the velocity
/// sensor's; zero: none. `spoil` makes the filter believe something else than the world does.
Sums Simulate(
    const char* name, int runs, double seconds, double sigma,
    const std::function<void(estimator::Setup&)>& spoil = [](estimator::Setup&) {}) {
  Sums sums;
  sums.runs = runs;
  const estimator::Setup world = NoisyWorld();
  Setup believed = world;
  believed.gate.action = GateAction::kOff;
  spoil(believed);
  for (int run = 0; run < runs; ++run) {
    SimulatedDrive drive(world, 1000 + static_cast<std::uint64_t>(run));
    auto filter = Make(name, believed, drive.DrawPrior(TestPrior().covariance));
    for (int i = 1; i <= static_cast<int>(seconds * 200); ++i) {
      (void)filter->Process(drive.Advance());
      if (sigma == 0.0 || i % 10 != 0) continue;
      const Report report = filter->Process(drive.Velocity(sigma));
      sums.nis += report.corrections()[0].nis;
      ++sums.corrections;
    }
    // One sample past the last correction: the gyroscope's noise that entered it over the sensor's
    // lever arm would be the same that enters the body's velocity, which no filter here models.
    (void)filter->Process(drive.Advance());
    const Estimate e = *filter->Belief();
    const ErrorVector error = ErrorOf(e, drive.Body());
    for (std::size_t b = 0; b < kBlocks.size(); ++b) {
      const Eigen::Vector3d part = error.segment<3>(kBlocks[b]);
      const Eigen::Matrix3d P = e.covariance.block<3, 3>(kBlocks[b], kBlocks[b]);
      sums.nees[b] += part.dot(P.ldlt().solve(part));
    }
    sums.all += error.dot(e.covariance.ldlt().solve(error));
  }
  return sums;
}

/// One in a million, both sides.
constexpr double kSigmas = 4.89;

bool Within(double sum, double dof) {
  return sum > ChiSquareAt(-kSigmas, dof) && sum < ChiSquareAt(kSigmas, dof);
}

bool Consistent(const Sums& s) {
  bool good = Within(s.all, 15.0 * s.runs);
  for (const double nees : s.nees) good = good && Within(nees, 3.0 * s.runs);
  return good && (s.corrections == 0 || Within(s.nis, 3.0 * s.corrections));
}

void ExpectConsistent(const Sums& s, const std::string& name) {
  for (std::size_t b = 0; b < kBlocks.size(); ++b) {
    EXPECT_TRUE(Within(s.nees[b], 3.0 * s.runs))
        << name << ", block " << kBlocks[b] << ": " << s.nees[b] / s.runs << ", expected 3";
  }
  EXPECT_TRUE(Within(s.all, 15.0 * s.runs)) << name << ": " << s.all / s.runs << ", expected 15";
  if (s.corrections > 0) {
    EXPECT_TRUE(Within(s.nis, 3.0 * s.corrections))
        << name << ": NIS " << s.nis / s.corrections << ", expected 3";
  }
}

class Consistency : public ::testing::TestWithParam<const char*> {};

TEST_P(Consistency, OfPropagationAlone) {
  ExpectConsistent(Simulate(GetParam(), 200, 2.0, 0.0), GetParam());
}

TEST_P(Consistency, WithBodyVelocity) {
  ExpectConsistent(Simulate(GetParam(), 200, 5.0, 0.02), GetParam());
}

TEST_P(Consistency, FailsWhenTheFilterBelievesSomethingElse) {
  const char* name = GetParam();
  const auto spoiled = [name](const std::function<void(estimator::Setup&)>& spoil) {
    return Consistent(Simulate(name, 60, 5.0, 0.02, spoil));
  };
  EXPECT_TRUE(spoiled([](estimator::Setup&) {})) << "the unspoiled run passes";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) {
    s.noise.gyro_noise_density_rad_per_s_sqrt_hz *= 0.316;
  })) << "gyroscope variance × 0.1";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) {
    s.noise.accel_noise_density_m_per_s2_sqrt_hz *= 0.316;
  })) << "accelerometer variance × 0.1";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) { s.noise.body_velocity_scale = 0.316; }))
      << "velocity variance × 0.1";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) { s.suite.sensors[2].X_BS.p.x() += 0.2; }))
      << "lever arm";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) {
    s.suite.sensors[2].X_BS.R = Exp({0, 0, 1.04});
  })) << "mounting of the velocity sensor off by 2°";
  EXPECT_FALSE(spoiled([](estimator::Setup& s) { s.estimate_gyro_bias = false; }))
      << "a bias state dropped";
}

INSTANTIATE_TEST_SUITE_P(Filters, Consistency, ::testing::Values("inekf", "mekf"));

}  // namespace
}  // namespace reckon::estimator
