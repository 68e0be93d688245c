#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// Which segments of a trajectory are compared.
enum class PairChoice {
  kConsecutive,  ///< end to end: the next one starts where the last one ended
  kAll,          ///< one from every sample that has an end near enough (10 % of the length)
};

/// Segments as (first, last) sample.
using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Segments of `frames` samples, among `size`.
IndexPairs PairsByFrames(std::size_t size, std::size_t frames, PairChoice choice);

/// Segments of `length_m` of accumulated true path. Consecutive: ends at the first sample that is
/// at least so far; all: at the nearest one.
IndexPairs PairsByPath(std::span<const TrackSample> samples, double length_m, PairChoice choice);

/// Segments of `length_s`, likewise.
IndexPairs PairsByTime(std::span<const TrackSample> samples, double length_s, PairChoice choice);

/// Relative errors of each segment: E = (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j), Q the truth and P the estimate
/// [Sturm12, eq. 1]; |trans(E)| and |Log rot(E)|.
struct RelativeErrors {
  std::vector<double> translation_m, rotation_deg;
};

RelativeErrors RelativeError(std::span<const TrackSample> samples, const IndexPairs& pairs);

/// Accumulated true path [m].
double PathLength(std::span<const TrackSample> samples);

}  // namespace reckon::ground_truth
