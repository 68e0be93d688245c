#include "reckon/ground_truth/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace reckon::ground_truth {
namespace {

double Median(std::span<const double> errors) {
  std::vector<double> sorted(errors.begin(), errors.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (sorted.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(sorted.begin(), middle));
}

}  // namespace

Statistics Summarise(std::span<const double> errors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0, sse = 0.0;
  for (const double error : errors) {
    sum += error;
    sse += error * error;
  }
  // An order of numbers that are not numbers is undefined: say so before any is compared.
  if (errors.empty() || !std::isfinite(sse)) return {nan, nan, nan, nan, nan, nan, nan};
  const double n = static_cast<double>(errors.size()), mean = sum / n;
  double spread = 0.0;
  for (const double error : errors) spread += (error - mean) * (error - mean);
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  return {std::sqrt(sse / n), mean, Median(errors), std::sqrt(spread / n), *least, *most, sse};
}

}  // namespace reckon::ground_truth
