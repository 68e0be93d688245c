#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/ground_truth/score_options.h"
#include "reckon/ground_truth/track.h"

namespace reckon::ground_truth {

/// One score: a stable name that holds its unit, and its value.
struct Metric {
  std::string name;
  double value = 0.0;   ///< NaN if it has none
  bool applies = true;  ///< false: this estimator or run has no such score (no covariance, no path)
  std::string unit, meaning;
};

/// The scores of one estimator in one run, in the order of the catalogue.
class Metrics {
 public:
  void Add(Metric metric) { list_.push_back(std::move(metric)); }
  void Add(std::string name, double value, bool applies = true);

  const std::vector<Metric>& list() const { return list_; }

  /// The value of the metric called `name`; nothing if it is missing or not finite.
  std::optional<double> Find(std::string_view name) const;

  /// Whether every metric that applies is finite, and every estimate was scored.
  bool valid() const;

 private:
  std::vector<Metric> list_;
};

/// All scores of the whole `track`. `sensors` names the sensors by id, `feet` the feet, if there
/// are any.
Metrics Score(const Track& track, const std::vector<std::string>& sensors,
              const ScoreOptions& options, const std::vector<std::string>& feet = {});

/// All metrics that Score gives for such a robot and options: names, units and meanings, no values.
Metrics MetricCatalogue(const std::vector<std::string>& sensors, const ScoreOptions& options,
                        const std::vector<std::string>& feet = {});

/// {"valid": …, "<name>": value or null, …}; the same metrics give the same bytes.
nlohmann::ordered_json ToJson(const Metrics& metrics);

}  // namespace reckon::ground_truth
