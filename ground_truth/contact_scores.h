#pragma once

#include <array>
#include <span>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// How often a belief of contact is right, and how late: rates are NaN where nothing counts.
struct ContactScores {
  double accuracy = 0.0;             ///< share of instants and feet
  double all_accuracy = 0.0;         ///< share of instants at which all feet are right
  double false_positive_rate = 0.0;  ///< FP / (FP + TN), of contact
  double false_negative_rate = 0.0;  ///< FN / (FN + TP)
  std::array<double, models::kMaxFeet> foot_accuracy{};
  double touchdown_delay_s = 0.0;                  ///< mean, from truth to belief; negative: early
  double liftoff_delay_s = 0.0;                    ///< likewise
  int touchdowns = 0, liftoffs = 0;                ///< that have a delay
  int missed_touchdowns = 0, missed_liftoffs = 0;  ///< that the belief never saw
};

/// Scores the beliefs of the first `feet` feet, at the instants that have one [Lin21, table 2].
///
/// For the delays, true phases shorter than `kShortestPhase` (the rebound of an impact) do not
/// count as phases. A touchdown is matched with the belief's rise that lies nearest, from half of
/// the swing before it to half of the stance behind it; a lift-off likewise.
ContactScores ScoreContacts(std::span<const TrackSample> samples, int feet);

inline constexpr models::TimeNs kShortestPhase = 20'000'000;

}  // namespace reckon::ground_truth
