#pragma once

#include <algorithm>
#include <cmath>

#include "reckon/estimator/covariance.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/models/time.h"

namespace reckon::estimator {

/// Whose fault it is that corrections do not fit. While more rows are used than rejected, a sensor
/// that is rejected is at fault; where most rows have been rejected for `patience_s` on end, the
/// belief is, and rejecting on would keep it wrong for ever. Rows are counted with a weight that
/// falls by 1/e in that time. A value; does not allocate.
class Mistrust {
 public:
  /// Zero: never of the belief.
  explicit Mistrust(double patience_s) : patience_s_(patience_s) {}

  /// From here on, as if nothing had been heard.
  void Start(models::TimeNs t_ns) {
    used_ = rejected_ = 0.0;
    t_ns_ = majority_ns_ = t_ns;
  }

  /// The gate has judged a correction of so many rows, in order of time.
  void Heard(models::TimeNs t_ns, int rows, bool rejected) {
    if (patience_s_ == 0.0) return;
    const double kept = std::exp(-std::max(0.0, models::Seconds(t_ns - t_ns_)) / patience_s_);
    t_ns_ = t_ns;
    if (used_ >= rejected_) majority_ns_ = t_ns;
    used_ *= kept;
    rejected_ *= kept;
    (rejected ? rejected_ : used_) += rows;
  }

  /// Whether the belief is at fault, and since when.
  bool OfBelief() const { return patience_s_ > 0.0 && seconds() >= patience_s_; }
  double seconds() const { return models::Seconds(t_ns_ - majority_ns_); }

 private:
  double patience_s_;
  double used_ = 0.0, rejected_ = 0.0;
  models::TimeNs t_ns_ = 0;
  models::TimeNs majority_ns_ = 0;  ///< until when most rows were used
};

/// By how much a belief that is at fault may be off, to be spent in the next step: its velocity,
/// its position by what that makes in the time, and its orientation by no more than linear
/// corrections can mend, some 20 degrees for two seconds.
struct Widening {
  double seconds = 0.0;
  double m_s = 0.0;

  /// Into the noise and the covariance of a step over `dt`, once.
  void Spend(ProcessNoise& noise, Covariance& P, double dt) {
    if (seconds == 0.0) return;
    constexpr double kTurnRate = 0.15;  // rad/s
    const double rad = kTurnRate * seconds, m = m_s * seconds;
    noise.gyro += rad * rad / dt;
    noise.accel += m_s * m_s / dt;
    P(kPositionSlot, kPositionSlot) += LaneMatrix::Diagonal(m * m);
    *this = {};
  }
};

}  // namespace reckon::estimator
