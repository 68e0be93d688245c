#pragma once

#include <span>

namespace reckon::ground_truth {

/// The seven statistics that evo gives of a list of errors; all NaN if there are none.
struct Statistics {
  double rmse, mean, median;
  double std;  ///< about the mean, divided by n (ddof 0)
  double min, max;
  double sse;  ///< sum of squares
};

Statistics Summarise(std::span<const double> errors);

}  // namespace reckon::ground_truth
