#include "reckon/ground_truth/rpe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/ground_truth/ate.h"

namespace reckon::ground_truth {
namespace {

constexpr double kRelativeTolerance = 0.1;

/// Accumulated true path at each sample.
std::vector<double> Path(std::span<const TrackSample> samples) {
  std::vector<double> path(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    path[i] = path[i - 1] + (samples[i].X_WB_true.p - samples[i - 1].X_WB_true.p).norm();
  }
  return path;
}

/// From every sample to the one whose mark is nearest to `length` further; of equals, the first.
IndexPairs AllPairs(const std::vector<double>& marks, double length) {
  IndexPairs pairs;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const auto miss = [&](auto at) { return std::abs(*at - marks[i] - length); };
    const auto begin = marks.begin() + static_cast<std::ptrdiff_t>(i + 1);
    auto nearest = std::lower_bound(begin, marks.end(), marks[i] + length);
    if (nearest != begin) {
      const auto before = std::lower_bound(begin, nearest, *(nearest - 1));
      if (nearest == marks.end() || miss(before) <= miss(nearest)) nearest = before;
    }
    if (miss(nearest) > kRelativeTolerance * length) continue;
    pairs.emplace_back(i, static_cast<std::size_t>(nearest - marks.begin()));
  }
  return pairs;
}

/// A new segment starts when the steps since the last start add up to `length`.
template <class Length, class Step>
IndexPairs ConsecutivePairs(std::size_t size, Length length, Step step) {
  IndexPairs pairs;
  std::size_t start = 0;
  Length since{};
  for (std::size_t i = 1; i < size; ++i) {
    since += step(i);
    if (since < length) continue;
    pairs.emplace_back(start, i);
    start = i;
    since = Length{};
  }
  return pairs;
}

}  // namespace

IndexPairs PairsByFrames(std::size_t size, std::size_t frames, PairChoice choice) {
  IndexPairs pairs;
  if (frames == 0) return pairs;
  const std::size_t stride = choice == PairChoice::kAll ? 1 : frames;
  for (std::size_t i = 0; i + frames < size; i += stride) pairs.emplace_back(i, i + frames);
  return pairs;
}

IndexPairs PairsByPath(std::span<const TrackSample> samples, double length_m, PairChoice choice) {
  if (choice == PairChoice::kAll) return AllPairs(Path(samples), length_m);
  return ConsecutivePairs(samples.size(), length_m, [&](std::size_t i) {
    return (samples[i].X_WB_true.p - samples[i - 1].X_WB_true.p).norm();
  });
}

IndexPairs PairsByTime(std::span<const TrackSample> samples, double length_s, PairChoice choice) {
  if (choice == PairChoice::kConsecutive) {
    const auto length_ns = static_cast<models::TimeNs>(std::llround(length_s * 1e9));
    return ConsecutivePairs(samples.size(), length_ns,
                            [&](std::size_t i) { return samples[i].t_ns - samples[i - 1].t_ns; });
  }
  std::vector<double> times;
  times.reserve(samples.size());
  for (const TrackSample& sample : samples) times.push_back(models::Seconds(sample.t_ns));
  return AllPairs(times, length_s);
}

RelativeErrors RelativeError(std::span<const TrackSample> samples, const IndexPairs& pairs) {
  RelativeErrors errors;
  errors.translation_m.reserve(pairs.size());
  errors.rotation_deg.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    const models::Pose truth = samples[i].X_WB_true.Inverse() * samples[j].X_WB_true;
    const models::Pose estimate = samples[i].X_WB.Inverse() * samples[j].X_WB;
    const models::Pose E = truth.Inverse() * estimate;
    errors.translation_m.push_back(E.p.norm());
    errors.rotation_deg.push_back(RotationAngle(E.R) * 180.0 / std::numbers::pi);
  }
  return errors;
}

double PathLength(std::span<const TrackSample> samples) {
  double length = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    length += (samples[i].X_WB_true.p - samples[i - 1].X_WB_true.p).norm();
  }
  return length;
}

}  // namespace reckon::ground_truth
