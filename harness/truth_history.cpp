#include "reckon/harness/truth_history.h"

#include <algorithm>

namespace reckon::harness {
namespace {

using ground_truth::Truth;

Truth Interpolate(const Truth& a, const Truth& b, models::TimeNs t_ns) {
  const double s = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  const Eigen::Quaterniond from(a.X_WB.R);
  const Eigen::Quaterniond to(b.X_WB.R);
  Truth truth = a;
  truth.t_ns = t_ns;
  truth.X_WB.R = from.slerp(s, to).toRotationMatrix();
  truth.X_WB.p += s * (b.X_WB.p - a.X_WB.p);
  truth.v_WB += s * (b.v_WB - a.v_WB);
  truth.w_WB_B += s * (b.w_WB_B - a.w_WB_B);
  return truth;
}

}  // namespace

std::optional<Truth> TruthHistory::At(models::TimeNs t_ns) const {
  const std::size_t first = next_ > ring_.size() ? next_ - ring_.size() : 0;
  if (next_ == 0 || t_ns < Entry(first).t_ns || t_ns > Entry(next_ - 1).t_ns) return std::nullopt;
  std::size_t low = next_ - 1;  // beliefs are a few instants old: look from the newest back
  while (Entry(low).t_ns > t_ns) --low;
  if (Entry(low).t_ns == t_ns) return Entry(low);
  if (longest_ns_ && Entry(low + 1).t_ns - Entry(low).t_ns > *longest_ns_) return std::nullopt;
  return Interpolate(Entry(low), Entry(low + 1), t_ns);
}

void TruthHistory::Pair(const estimator::Estimate& estimate, ground_truth::Track& track) const {
  if (const auto truth = At(estimate.t_ns)) {
    track.Add(*truth, estimate);
  } else if (!longest_ns_) {
    track.AddUnpaired();
  }
}

}  // namespace reckon::harness
