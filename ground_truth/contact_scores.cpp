#include "reckon/ground_truth/contact_scores.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace reckon::ground_truth {
namespace {

using models::TimeNs;

double Share(double part, double whole) {
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

/// When a switch changes: it is off before the first edge if `starts_on` is false, and so on in
/// turns.
struct Edges {
  bool starts_on = false;
  std::vector<TimeNs> at;
};

template <class IsOn>
Edges EdgesOf(std::span<const TrackSample> samples, const IsOn& is_on) {
  Edges edges;
  bool last = false, first = true;
  for (const TrackSample& sample : samples) {
    if (!sample.feet.said) continue;
    const bool on = is_on(sample.feet);
    if (first) edges.starts_on = on;
    if (!first && on != last) edges.at.push_back(sample.t_ns);
    last = on;
    first = false;
  }
  return edges;
}

/// Without the phases that are shorter than `least_ns`, between two edges.
Edges Settled(const Edges& edges, TimeNs least_ns) {
  Edges settled{edges.starts_on, {}};
  for (const TimeNs t_ns : edges.at) {
    if (!settled.at.empty() && t_ns - settled.at.back() < least_ns) {
      settled.at.pop_back();
    } else {
      settled.at.push_back(t_ns);
    }
  }
  return settled;
}

/// The edge of `belief` that turns to `on` and lies nearest to `t_ns`, from `from_ns` to `to_ns`.
const TimeNs* Nearest(const Edges& belief, bool on, TimeNs t_ns, TimeNs from_ns, TimeNs to_ns) {
  const TimeNs* nearest = nullptr;
  for (std::size_t k = 0; k < belief.at.size(); ++k) {
    const bool turns_on = (k % 2 == 0) != belief.starts_on;
    const TimeNs& edge_ns = belief.at[k];
    if (turns_on != on || edge_ns < from_ns || edge_ns > to_ns) continue;
    if (nearest == nullptr || std::abs(edge_ns - t_ns) < std::abs(*nearest - t_ns)) {
      nearest = &edge_ns;
    }
  }
  return nearest;
}

struct Delays {
  double touchdown_s = 0.0, liftoff_s = 0.0;  ///< sums
};

/// Edges without a phase on both sides are left out.
void AddDelays(const Edges& truth, const Edges& belief, Delays& sums, ContactScores& scores) {
  for (std::size_t k = 1; k + 1 < truth.at.size(); ++k) {
    const bool on = (k % 2 == 0) != truth.starts_on;
    const TimeNs t_ns = truth.at[k];
    const TimeNs from_ns = (truth.at[k - 1] + t_ns) / 2, to_ns = (t_ns + truth.at[k + 1]) / 2;
    const TimeNs* edge = Nearest(belief, on, t_ns, from_ns, to_ns);
    if (edge == nullptr) {
      ++(on ? scores.missed_touchdowns : scores.missed_liftoffs);
      continue;
    }
    ++(on ? scores.touchdowns : scores.liftoffs);
    (on ? sums.touchdown_s : sums.liftoff_s) += models::Seconds(*edge - t_ns);
  }
}

}  // namespace

ContactScores ScoreContacts(std::span<const TrackSample> samples, int feet) {
  double instants = 0.0, all_right = 0.0;
  double true_on = 0.0, true_off = 0.0, false_on = 0.0, false_off = 0.0;
  std::array<double, models::kMaxFeet> right{};
  for (const TrackSample& sample : samples) {
    if (!sample.feet.said) continue;
    instants += 1.0;
    bool all = true;
    for (int i = 0; i < feet; ++i) {
      const bool truth = sample.feet.Stands(i), belief = sample.feet.IsBelieved(i);
      (truth ? true_on : true_off) += 1.0;
      if (belief && !truth) false_on += 1.0;
      if (truth && !belief) false_off += 1.0;
      if (truth == belief) right[static_cast<std::size_t>(i)] += 1.0;
      all = all && truth == belief;
    }
    if (all) all_right += 1.0;
  }
  ContactScores scores;
  scores.accuracy = Share(true_on + true_off - false_on - false_off, true_on + true_off);
  scores.all_accuracy = Share(all_right, instants);
  scores.false_positive_rate = Share(false_on, true_off);
  scores.false_negative_rate = Share(false_off, true_on);
  Delays sums;
  for (int i = 0; i < feet; ++i) {
    scores.foot_accuracy[static_cast<std::size_t>(i)] =
        Share(right[static_cast<std::size_t>(i)], instants);
    const auto truth = EdgesOf(samples, [i](const FeetBelief& f) { return f.Stands(i); });
    const auto belief = EdgesOf(samples, [i](const FeetBelief& f) { return f.IsBelieved(i); });
    AddDelays(Settled(truth, kShortestPhase), belief, sums, scores);
  }
  scores.touchdown_delay_s = Share(sums.touchdown_s, scores.touchdowns);
  scores.liftoff_delay_s = Share(sums.liftoff_s, scores.liftoffs);
  return scores;
}

}  // namespace reckon::ground_truth
