#include "reckon/ground_truth/consistency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ground_truth/tracks.h"

namespace reckon::ground_truth {
namespace {

TEST(ChiSquareMeanBounds, EqualPublishedTables) {
  // N, n and the two-sided bounds at 95 % and at 1 − 1e-6, computed by another program (two
  // decimals).
  struct Row {
    double count, dof, false_alarm, lower, upper;
  };
  for (const Row& row :
       {Row{10, 3, 0.05, 1.68, 4.70}, Row{50, 3, 0.05, 2.36, 3.72}, Row{50, 9, 0.001, 7.16, 11.11},
        Row{10, 3, 1e-6, 0.59, 8.41}, Row{100, 15, 1e-6, 12.47, 17.83}}) {
    const Interval bounds = ChiSquareMeanBounds(row.dof, row.count, row.false_alarm);
    EXPECT_NEAR(bounds.lower, row.lower, 0.005001);
    EXPECT_NEAR(bounds.upper, row.upper, 0.005001);
  }
  EXPECT_THROW((void)ChiSquareMeanBounds(3, 0, 0.05), std::invalid_argument);
  EXPECT_THROW((void)ChiSquareMeanBounds(3, 1, 0.0), std::invalid_argument);
}

/// A run with white errors and innovations whose covariances claim `claimed` times their variance.
Track HonestyRun(unsigned seed, double claimed_state, double claimed_innovation,
                 double seconds = 60.0) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    return Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  };
  Track track;
  for (int k = 0; k < static_cast<int>(20 * seconds); ++k) {
    Truth truth;
    truth.t_ns = k * 50'000'000LL;
    estimator::Estimate estimate = testing::Exact(truth);
    estimate.form = estimator::ErrorForm::kMultiplicative;
    estimate.has_covariance = estimate.has_biases = true;
    const Eigen::Vector3d theta = 1e-3 * draw();
    estimate.X_WB = {testing::Rot(theta.norm(), theta), 0.1 * draw()};
    estimate.v_WB = 0.1 * draw();
    estimate.gyro_bias_rad_s = 1e-3 * draw();
    estimate.accel_bias_m_s2 = 1e-2 * draw();
    estimate.covariance.diagonal() << Eigen::Vector3d::Constant(1e-6),
        Eigen::Matrix<double, 6, 1>::Constant(1e-2), Eigen::Vector3d::Constant(1e-6),
        Eigen::Vector3d::Constant(1e-4);
    estimate.covariance *= claimed_state;
    track.Add(truth, estimate);
    estimator::Correction correction;
    correction.t_ns = truth.t_ns;
    correction.sensor = 1;
    correction.rows = 3;
    correction.innovation = draw();
    correction.covariance = Eigen::Matrix3d::Identity() * claimed_innovation;
    correction.nis = correction.innovation.squaredNorm() / claimed_innovation;
    track.Add(correction);
  }
  return track;
}

const std::vector<std::string> kSensors{"imu", "wheels"};

std::vector<std::string> Failures(const Track& track, double false_alarm) {
  std::vector<std::string> names;
  for (const auto& test : CheckConsistency(track, kSensors, false_alarm)) {
    if (!test.holds) names.push_back(test.name);
  }
  return names;
}

bool AnyStartsWith(const std::vector<std::string>& names, const std::string& text) {
  return std::any_of(names.begin(), names.end(),
                     [&text](const std::string& name) { return name.starts_with(text); });
}

TEST(Consistency, TestsOneSensorAndSixBlocksAtTenTimes) {
  const auto tests = CheckConsistency(HonestyRun(1, 1.0, 1.0), kSensors, 1e-6);
  EXPECT_EQ(tests.size(), 2U + 6U * 10U);
  EXPECT_EQ(tests[0].name, "nis wheels");
  EXPECT_EQ(tests[1].name, "whiteness wheels");
  EXPECT_EQ(tests[2].name, "nees orientation at 5.950 s");  // the last sample is at 59.95 s
  // Each test's part of the false alarms: the bounds of a lone χ²_3.
  const Interval bounds = ChiSquareMeanBounds(3, 1, 1e-6 / 62);
  EXPECT_EQ(tests[2].bounds.lower, bounds.lower);
  EXPECT_EQ(tests[2].bounds.upper, bounds.upper);
}

/// At a family rate of 5 %, 200 honest runs fail about ten times; Bonferroni's bound is from above.
TEST(Consistency, RaisesNoMoreFalseAlarmsThanAsked) {
  int failed = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    failed += Failures(HonestyRun(seed, 1.0, 1.0, 10.0), 0.05).empty() ? 0 : 1;
  }
  // Binomial(200, 0.05): 10 ± 3.1; 26 is five sigma above. Zero would mean a gate that never
  // closes.
  EXPECT_LE(failed, 26);
  EXPECT_GE(failed, 1);
}

TEST(Consistency, FailsAFilterThatClaimsTooMuch) {
  const auto noise =
      Failures(HonestyRun(1, 1.0, 0.1), 1e-6);  // innovation variances a tenth of the truth
  EXPECT_EQ(noise, std::vector<std::string>{"nis wheels"});
  const auto state = Failures(HonestyRun(1, 0.05, 1.0), 1e-6);
  EXPECT_FALSE(AnyStartsWith(state, "nis"));
  EXPECT_TRUE(AnyStartsWith(state, "nees full"));
}

TEST(Consistency, FailsAFilterThatClaimsTooLittle) {
  EXPECT_EQ(Failures(HonestyRun(1, 1.0, 3.0), 1e-6), std::vector<std::string>{"nis wheels"});
  EXPECT_TRUE(AnyStartsWith(Failures(HonestyRun(1, 100.0, 1.0), 1e-6), "nees full"));
}

TEST(Consistency, SaysByHowMuch) {
  const auto tests = CheckConsistency(HonestyRun(1, 1.0, 0.1), kSensors, 1e-6);
  EXPECT_NE(tests[0].message.find("nis wheels is 3"), std::string::npos);  // about 30
  EXPECT_NE(tests[0].message.find("off by a factor of"), std::string::npos);
  EXPECT_GT(tests[0].value / tests[0].bounds.upper, 5.0);
}

TEST(Consistency, FailsInnovationsThatAreNotWhite) {
  // The same innovation three times in a row: honest in size, correlated by 2/3.
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  Track track;
  estimator::Correction correction;
  correction.sensor = 1;
  correction.rows = 3;
  correction.covariance.setIdentity();
  for (int k = 0; k < 3000; ++k) {
    correction.t_ns = k;
    if (k % 3 == 0)
      correction.innovation = {normal(generator), normal(generator), normal(generator)};
    correction.nis = correction.innovation.squaredNorm();
    track.Add(correction);
  }
  EXPECT_TRUE(AnyStartsWith(Failures(track, 1e-6), "whiteness wheels"));
}

TEST(Consistency, ComplainsOncePerSubject) {
  const auto complaints = Complaints(CheckConsistency(HonestyRun(1, 100.0, 0.1), kSensors, 1e-6));
  const auto starts = [&](const std::string& text) { return AnyStartsWith(complaints, text); };
  EXPECT_TRUE(starts("nis wheels is too sure in 1 of 1 tests: "));
  EXPECT_TRUE(starts("nees full is too cautious in 10 of 10 tests: "));
  EXPECT_LE(complaints.size(), 7U);  // the sensor and six blocks
}

TEST(Consistency, FailsWhatCantBeTested) {
  const auto empty = CheckConsistency(Track(), kSensors, 1e-6);
  ASSERT_EQ(empty.size(), 1U);
  EXPECT_FALSE(empty[0].holds);

  Track broken = HonestyRun(1, 1.0, 1.0);
  Truth truth;
  truth.t_ns = 60 * models::kNsPerSecond;
  estimator::Estimate estimate = testing::Exact(truth);
  estimate.has_covariance = true;
  estimate.covariance = -estimator::ErrorCovariance::Identity();
  broken.Add(truth, estimate);
  EXPECT_TRUE(AnyStartsWith(Failures(broken, 1e-6), "covariance"));

  Track poisoned;
  truth.X_WB.p.x() = std::numeric_limits<double>::quiet_NaN();
  estimate.covariance = estimator::ErrorCovariance::Identity();
  poisoned.Add(truth, estimate);
  EXPECT_TRUE(AnyStartsWith(Failures(poisoned, 1e-6), "nees position"));
}

TEST(Anees, OfHonestRunsLiesInsideAndOfBoastfulOnesOutside) {
  std::mt19937_64 generator(5);
  std::chi_squared_distribution<double> chi(3.0);
  Eigen::MatrixXd nees(50, 10);
  for (double& value : nees.reshaped()) value = chi(generator);
  const Anees honest = AneesOf(nees, 3, 1e-6);
  EXPECT_TRUE(honest.holds());
  EXPECT_EQ(honest.mean.size(), 10);
  EXPECT_NEAR(honest.bounds.lower, ChiSquareMeanBounds(3, 50, 1e-7).lower, 1e-12);
  EXPECT_FALSE(AneesOf(2.0 * nees, 3, 1e-6).holds());  // variances claimed at half their size
  nees(7, 3) = std::nan("");
  EXPECT_FALSE(AneesOf(nees, 3, 1e-6).holds());
  EXPECT_THROW((void)AneesOf(Eigen::MatrixXd(), 3, 1e-6), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::ground_truth
