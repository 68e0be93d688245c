#include "reckon/ground_truth/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "reckon/ground_truth/nis.h"

namespace reckon::ground_truth {
namespace {

/// How far beyond its bounds a value lies: more than 1 if it does.
double Miss(const ConsistencyTest& test) {
  const Interval& bounds = test.bounds;
  const bool below = test.value < bounds.lower && bounds.lower > 0.0;
  return below ? bounds.lower / test.value : std::abs(test.value) / bounds.upper;
}

void Judge(ConsistencyTest& test, Interval bounds) {
  test.bounds = bounds;
  test.holds = bounds.Contains(test.value);
  test.message = fmt::format("{} is {:.4g}, an honest filter gives {:.4g} to {:.4g}", test.name,
                             test.value, bounds.lower, bounds.upper);
  if (!test.holds) test.message += fmt::format(" (off by a factor of {:.3g})", Miss(test));
}

ConsistencyTest Failed(std::string name, const std::string& what) {
  ConsistencyTest test;
  test.name = std::move(name);
  test.subject = test.name;
  test.value = std::nan("");
  test.message = test.name + ": " + what;
  return test;
}

/// The last sample at or before each of the fixed times.
std::vector<const TrackSample*> FixedTimes(const std::vector<TrackSample>& samples) {
  std::vector<const TrackSample*> chosen;
  if (samples.empty()) return chosen;
  const models::TimeNs first = samples.front().t_ns, span = samples.back().t_ns - first;
  for (int k = 1; k <= kNeesTimes; ++k) {
    const models::TimeNs time = first + span / kNeesTimes * k + span % kNeesTimes * k / kNeesTimes;
    const auto after = std::upper_bound(
        samples.begin(), samples.end(), time,
        [](models::TimeNs t, const TrackSample& sample) { return t < sample.t_ns; });
    const TrackSample* sample = &*(after - 1);
    if (chosen.empty() || chosen.back() != sample) chosen.push_back(sample);
  }
  return chosen;
}

bool IsEstimated(const std::vector<TrackSample>& samples, std::size_t block) {
  return std::any_of(samples.begin(), samples.end(),
                     [block](const TrackSample& sample) { return sample.nees.estimated[block]; });
}

/// One test and the bounds that a false alarm gives it.
struct Planned {
  ConsistencyTest test;
  std::function<Interval(double false_alarm)> bounds;
};

/// The interval of a normal variable about zero.
Interval NormalBounds(double sigma, double false_alarm) {
  const double bound = sigma * quantile(complement(boost::math::normal(), 0.5 * false_alarm));
  return {-bound, bound};
}

void PlanNis(const Track& track, const std::vector<std::string>& sensors,
             std::vector<Planned>& plan) {
  for (std::size_t id = 0; id < sensors.size(); ++id) {
    const NisStatistics nis = NisOf(track.corrections(), static_cast<models::SensorId>(id));
    if (nis.corrections == 0) continue;
    const double count = static_cast<double>(nis.corrections);
    ConsistencyTest mean, whiteness;
    mean.subject = mean.name = "nis " + sensors[id];
    mean.value = nis.mean;
    whiteness.subject = whiteness.name = "whiteness " + sensors[id];
    whiteness.value = nis.lag1;
    plan.push_back({mean, [=](double false_alarm) {
                      return ChiSquareMeanBounds(nis.dof, count, false_alarm);
                    }});
    plan.push_back({whiteness, [=](double false_alarm) {
                      return NormalBounds(1.0 / std::sqrt(count * nis.dof), false_alarm);
                    }});
  }
}

void PlanNees(const Track& track, std::vector<Planned>& plan) {
  const auto times = FixedTimes(track.samples());
  for (std::size_t block = 0; block < kNeesBlocks; ++block) {
    if (!IsEstimated(track.samples(), block)) continue;
    const int number = static_cast<int>(block);
    for (const TrackSample* sample : times) {
      ConsistencyTest test;
      test.subject = fmt::format("nees {}", NeesBlockName(number));
      test.name = fmt::format("{} at {:.3f} s", test.subject, models::Seconds(sample->t_ns));
      test.value = sample->nees.value[block];
      plan.push_back({test, [number](double false_alarm) {
                        return ChiSquareMeanBounds(NeesDof(number), 1.0, false_alarm);
                      }});
    }
  }
}

}  // namespace

Interval ChiSquareMeanBounds(double dof, double count, double false_alarm) {
  if (!(dof > 0.0 && count > 0.0 && false_alarm > 0.0 && false_alarm < 1.0)) {
    throw std::invalid_argument(
        fmt::format("no χ² bounds for dof {}, count {}, false alarm {}", dof, count, false_alarm));
  }
  const boost::math::chi_squared distribution(dof * count);
  return {quantile(distribution, 0.5 * false_alarm) / count,
          quantile(complement(distribution, 0.5 * false_alarm)) / count};
}

std::vector<ConsistencyTest> CheckConsistency(const Track& track,
                                              const std::vector<std::string>& sensors,
                                              double false_alarm) {
  std::vector<Planned> plan;
  PlanNis(track, sensors, plan);
  PlanNees(track, plan);
  std::vector<ConsistencyTest> tests;
  for (Planned& planned : plan) {
    if (!std::isfinite(planned.test.value)) {
      tests.push_back(Failed(planned.test.name, "is not a number"));
      continue;
    }
    Judge(planned.test, planned.bounds(false_alarm / static_cast<double>(plan.size())));
    tests.push_back(planned.test);
  }
  for (const TrackSample& sample : track.samples()) {
    if (!sample.nees.indefinite) continue;
    tests.push_back(Failed("covariance", fmt::format("not positive definite at {:.3f} s",
                                                     models::Seconds(sample.t_ns))));
    break;
  }
  if (tests.empty()) tests.push_back(Failed("consistency", "no covariance and no innovations"));
  return tests;
}

std::vector<std::string> Complaints(const std::vector<ConsistencyTest>& tests) {
  struct Side {
    std::size_t failed = 0;
    const ConsistencyTest* worst = nullptr;
  };
  std::vector<std::string> complaints;
  std::map<std::string, std::size_t> asked;
  std::map<std::pair<std::string, bool>, Side> sides;  // by subject, and whether it is too sure
  for (const ConsistencyTest& test : tests) {
    ++asked[test.subject];
    if (test.holds) continue;
    if (!std::isfinite(test.value)) {
      complaints.push_back(test.message);
      continue;
    }
    Side& side = sides[{test.subject, test.value > test.bounds.upper}];
    ++side.failed;
    if (side.worst == nullptr || Miss(test) > Miss(*side.worst)) side.worst = &test;
  }
  for (const auto& [key, side] : sides) {
    const std::string fault = key.first.starts_with("whiteness") ? "is not white"
                              : key.second                       ? "is too sure"
                                                                 : "is too cautious";
    complaints.push_back(fmt::format("{} {} in {} of {} tests: {}", key.first, fault, side.failed,
                                     asked[key.first], side.worst->message));
  }
  return complaints;
}

bool Anees::holds() const {
  return std::all_of(mean.begin(), mean.end(), [this](double m) { return bounds.Contains(m); });
}

Anees AneesOf(const Eigen::MatrixXd& nees, int dof, double false_alarm) {
  if (nees.size() == 0) throw std::invalid_argument("ANEES of no runs");
  return {nees.colwise().mean().transpose(),
          ChiSquareMeanBounds(dof, static_cast<double>(nees.rows()),
                              false_alarm / static_cast<double>(nees.cols()))};
}

}  // namespace reckon::ground_truth
