#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

struct Interval {
  double lower = 0.0, upper = 0.0;

  bool Contains(double value) const { return value >= lower && value <= upper; }
};

/// Where the mean of `count` independent χ² variables of `dof` degrees lies with probability
/// 1 − false_alarm, half of the rest on each side: χ²_{α/2, count·dof}/count … χ²_{1−α/2, …}/count.
/// `count` need not be whole. Throws std::invalid_argument for arguments that are not positive.
Interval ChiSquareMeanBounds(double dof, double count, double false_alarm);

/// One test of a run's honesty.
struct ConsistencyTest {
  std::string name;     ///< `nis wheels`, `whiteness wheels`, `nees position at 12.000 s`
  std::string subject;  ///< the same without the time
  double value = 0.0;
  Interval bounds;
  bool holds = false;
  std::string message;  ///< what was found and what an honest filter would give
};

/// The most times at which a run's NEES is tested.
inline constexpr int kNeesTimes = 10;

/// Tests one run, with at most `false_alarm` probability that an honest filter fails any of it
/// (Bonferroni: each of the tests gets an equal part):
/// - per sensor, the time-mean NIS against χ², as innovations of an honest filter are white; and
///   that they are, by the correlation of successive ones against its normal limit;
/// - per block and at `kNeesTimes` fixed times, evenly spaced up to the end, the NEES against χ².
/// A covariance that is not positive definite, or nothing to test, is a failed test.
std::vector<ConsistencyTest> CheckConsistency(const Track& track,
                                              const std::vector<std::string>& sensors,
                                              double false_alarm);

/// One sentence for each subject that fails a test: too sure (above) or too cautious (below), how
/// often, and the worst of its tests.
std::vector<std::string> Complaints(const std::vector<ConsistencyTest>& tests);

/// NEES averaged over runs: one value a time, and the interval of an honest filter at each.
struct Anees {
  Eigen::VectorXd mean;
  Interval bounds;

  /// Whether every time lies inside.
  bool holds() const;
};

/// `nees` has a row a run and a column a time; every entry must be a number. The family of all
/// columns has at most `false_alarm` (Bonferroni).
Anees AneesOf(const Eigen::MatrixXd& nees, int dof, double false_alarm);

}  // namespace reckon::ground_truth
