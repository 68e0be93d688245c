#include "reckon/harness/expectations.h"

#include <fmt/format.h>

#include <cmath>

namespace reckon::harness {
namespace {

/// `value` against `limit`: by how much it misses, in the metric's unit and relative to the limit.
std::string Miss(double value, double limit) {
  const double by = std::abs(value - limit);
  if (limit == 0.0) return fmt::format("found {:.6g}, off by {:.3g}", value, by);
  return fmt::format("found {:.6g}, off by {:.3g} ({:.1f} %)", value, by,
                     100.0 * by / std::abs(limit));
}

Verdict JudgeLimit(const std::string& estimator, const std::string& metric, double limit, bool max,
                   std::optional<double> value) {
  Verdict verdict;
  verdict.expectation = fmt::format("{}.{} {} {}", estimator, metric, max ? "<=" : ">=", limit);
  if (!value) {
    verdict.detail = "there is no such number in this run";
    return verdict;
  }
  verdict.holds = max ? *value <= limit : *value >= limit;
  if (!verdict.holds) verdict.detail = Miss(*value, limit);
  return verdict;
}

Verdict JudgeComparison(const Comparison& comparison, const Findings& findings) {
  Verdict verdict;
  verdict.expectation = comparison.text;
  const auto left = findings.metric(comparison.left_estimator, comparison.left_metric);
  const auto right = findings.metric(comparison.right_estimator, comparison.right_metric);
  if (!left || !right) {
    verdict.detail = "one side has no number in this run";
    return verdict;
  }
  const double limit = comparison.factor * *right;
  verdict.holds = comparison.less ? *left < limit : *left > limit;
  if (!verdict.holds) {
    verdict.detail = fmt::format("{:.6g} against {:.6g}", *left, limit);
  }
  return verdict;
}

Verdict JudgeConsistency(const std::string& estimator, double false_alarm,
                         const Findings& findings) {
  Verdict verdict;
  verdict.expectation = fmt::format("{} is consistent (false alarm {:g})", estimator, false_alarm);
  const auto complaints = findings.inconsistencies(estimator, false_alarm);
  verdict.holds = complaints.empty();
  verdict.detail = fmt::format("{}", fmt::join(complaints, "\n    "));
  return verdict;
}

}  // namespace

std::vector<Verdict> Judge(const ExpectConfig& expect, const Findings& findings) {
  std::vector<Verdict> verdicts;
  for (const auto& [estimator, expectation] : expect.estimators) {
    for (const Bound& bound : expectation.bounds) {
      const auto value = findings.metric(estimator, bound.metric);
      if (bound.min) {
        verdicts.push_back(JudgeLimit(estimator, bound.metric, *bound.min, false, value));
      }
      if (bound.max) {
        verdicts.push_back(JudgeLimit(estimator, bound.metric, *bound.max, true, value));
      }
    }
    if (expectation.consistency_false_alarm) {
      verdicts.push_back(
          JudgeConsistency(estimator, *expectation.consistency_false_alarm, findings));
    }
  }
  for (const Comparison& comparison : expect.compare) {
    verdicts.push_back(JudgeComparison(comparison, findings));
  }
  return verdicts;
}

}  // namespace reckon::harness
