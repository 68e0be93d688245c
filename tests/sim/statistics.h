#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

// Sample statistics and their acceptance bands. A band of five standard deviations of the estimator
// is left by chance once in 1.7 million draws of a seed; the seeds here are fixed.
namespace reckon::testing_sim {

inline double Mean(std::span<const double> x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

inline double Variance(std::span<const double> x) {
  const double mean = Mean(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(x.size() - 1);
}

/// Correlation of x[n] and y[n + lag].
inline double Correlation(std::span<const double> x, std::span<const double> y,
                          std::size_t lag = 0) {
  const double mean_x = Mean(x), mean_y = Mean(y);
  double sum = 0.0;
  for (std::size_t n = 0; n + lag < x.size(); ++n) sum += (x[n] - mean_x) * (y[n + lag] - mean_y);
  return sum / (static_cast<double>(x.size()) * std::sqrt(Variance(x) * Variance(y)));
}

/// Five standard deviations of the mean of n draws of variance σ².
inline double MeanBand(double sigma, std::size_t n) {
  return 5.0 * sigma / std::sqrt(static_cast<double>(n));
}

/// Five standard deviations of the sample variance of n normal draws.
inline double VarianceBand(double sigma, std::size_t n) {
  return 5.0 * sigma * sigma * std::sqrt(2.0 / static_cast<double>(n - 1));
}

/// Five standard deviations of the sample correlation of n independent pairs.
inline double CorrelationBand(std::size_t n) { return 5.0 / std::sqrt(static_cast<double>(n)); }

/// Overlapping Allan deviation of a rate over clusters of m samples.
inline double AllanDeviation(std::span<const double> rate, std::size_t m) {
  std::vector<double> integral(rate.size() + 1, 0.0);
  for (std::size_t n = 0; n < rate.size(); ++n) integral[n + 1] = integral[n] + rate[n];
  const std::size_t count = integral.size() - 2 * m;
  double sum = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const double d = integral[n + 2 * m] - 2.0 * integral[n + m] + integral[n];
    sum += d * d;
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(m * m) * static_cast<double>(count)));
}

/// Slope of the least-squares line through the points (x, y).
inline double Slope(std::span<const double> x, std::span<const double> y) {
  return Correlation(x, y) * std::sqrt(Variance(y) / Variance(x)) * static_cast<double>(x.size()) /
         static_cast<double>(x.size() - 1);
}

}  // namespace reckon::testing_sim
