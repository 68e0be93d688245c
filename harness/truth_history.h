#pragma once

#include <optional>
#include <vector>

#include "reckon/ground_truth/track.h"
#include "reckon/ground_truth/truth.h"

namespace reckon::harness {

/// The newest stretch of truth, a bounded ring: estimates carry the stamp of the sample that moved
/// them, which lies a little in the past.
class TruthHistory {
 public:
  explicit TruthHistory(std::size_t capacity) : ring_(capacity) {}

  /// Truth that has holes, as of a motion capture: estimates where there is none, or that lie
  /// between rows that are further apart than 0.1 s, are not scored, and that is no error.
  void AllowHoles() { longest_ns_ = kLongestHole; }

  void Add(const ground_truth::Truth& truth) {
    ring_[next_ % ring_.size()] = truth;
    ++next_;
  }

  /// Truth at `t_ns`: the recorded instant itself, or between two instants the interpolated pose,
  /// velocity and rates (a misreported stamp need not lie on the physics grid). Nothing for an
  /// instant outside the ring.
  std::optional<ground_truth::Truth> At(models::TimeNs t_ns) const;

  /// Adds `estimate` to `track` beside the truth at its stamp, or as one that has none.
  void Pair(const estimator::Estimate& estimate, ground_truth::Track& track) const;

 private:
  static constexpr models::TimeNs kLongestHole = 100'000'000;

  const ground_truth::Truth& Entry(std::size_t i) const { return ring_[i % ring_.size()]; }

  std::vector<ground_truth::Truth> ring_;
  std::size_t next_ = 0;  ///< entries ever added
  std::optional<models::TimeNs> longest_ns_;
};

}  // namespace reckon::harness
