#include "reckon/harness/comparison.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace reckon::harness {
namespace {

constexpr const char* kExpected =
    "a comparison such as `riekf.final_drift_m < 0.8 * mekf.final_drift_m`";

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Splits `estimator.metric`.
void Split(const std::string& side, std::string& estimator, std::string& metric) {
  const std::size_t dot = side.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == side.size() ||
      side.find_first_of(" \t<>*") != std::string::npos) {
    throw std::invalid_argument(kExpected);
  }
  estimator = side.substr(0, dot);
  metric = side.substr(dot + 1);
}

}  // namespace

Comparison TextForm<Comparison>::Read(const std::string& text) {
  Comparison comparison;
  comparison.text = text;
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos) throw std::invalid_argument(kExpected);
  comparison.less = text[sign] == '<';
  Split(Trimmed(text.substr(0, sign)), comparison.left_estimator, comparison.left_metric);
  std::string right = Trimmed(text.substr(sign + 1));
  if (const std::size_t star = right.find('*'); star != std::string::npos) {
    const std::string factor = Trimmed(right.substr(0, star));
    const char* end = factor.data() + factor.size();
    const auto read = std::from_chars(factor.data(), end, comparison.factor);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(comparison.factor)) {
      throw std::invalid_argument(kExpected);
    }
    right = Trimmed(right.substr(star + 1));
  }
  Split(right, comparison.right_estimator, comparison.right_metric);
  return comparison;
}

}  // namespace reckon::harness
