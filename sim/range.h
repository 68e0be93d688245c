#pragma once

#include <string>

namespace reckon::sim {

/// The numbers that a key of a configuration takes, in the key's unit. One constant says it to the
/// code that refuses the rest and to whoever describes the key to users.
struct Range {
  double min, max;
  bool above_min = false;  ///< `min` itself is outside

  /// False for what is not a number.
  constexpr bool Holds(double value) const {
    return (above_min ? value > min : value >= min) && value <= max;
  }
};

constexpr Range AboveUpTo(double min, double max) { return {min, max, true}; }

/// Throws std::invalid_argument "<section>: <key> is <value>, expected <range>" for what `range`
/// does not hold.
void RequireIn(const Range& range, double value, const std::string& section,
               const std::string& key);

}  // namespace reckon::sim
