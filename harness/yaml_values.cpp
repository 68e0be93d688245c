#include "reckon/harness/yaml_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace reckon::harness {
namespace {

std::string_view WithoutPlus(const YamlNode& node) {
  std::string_view text = node.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

bool IsPlainNumber(const YamlNode& node) {
  return node.is_scalar() && KindOf(node) == ScalarKind::kNumber;
}

}  // namespace

std::string LimitsText(const Limits& limits) {
  const bool low = std::isfinite(limits.min), high = std::isfinite(limits.max);
  if (low && high && !limits.above_min) {
    return " from " + NumberText(limits.min) + " to " + NumberText(limits.max);
  }
  std::string text;
  if (low) text += (limits.above_min ? " above " : " of at least ") + NumberText(limits.min);
  if (high) text += (low ? " and" : " of") + (" at most " + NumberText(limits.max));
  return text;
}

bool Holds(const Limits& limits, double value) {
  return std::isfinite(value) && value <= limits.max &&
         (limits.above_min ? value > limits.min : value >= limits.min);
}

void Expected(const YamlNode& node, const std::string& path, const std::string& what,
              Problems& problems) {
  problems.Add(node.at, "'" + path + "': expected " + what + ", found " + Found(node));
}

std::optional<double> ReadNumber(const YamlNode& node, const std::string& path,
                                 const Limits& limits, Problems& problems) {
  if (IsPlainNumber(node)) {
    const std::string_view text = WithoutPlus(node);
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec == std::errc() && read.ptr == text.data() + text.size() && Holds(limits, value)) {
      return value;
    }
  }
  Expected(node, path, "a finite number" + LimitsText(limits), problems);
  return std::nullopt;
}

std::optional<std::uint64_t> ReadWhole(const YamlNode& node, const std::string& path,
                                       const Limits& limits, Problems& problems) {
  if (IsPlainNumber(node)) {
    const std::string_view text = WithoutPlus(node);
    std::uint64_t value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec == std::errc() && read.ptr == text.data() + text.size() &&
        Holds(limits, static_cast<double>(value))) {
      return value;
    }
  }
  const Limits shown{std::max(limits.min, 0.0), limits.max, false};
  Expected(node, path, "a whole number" + LimitsText(shown), problems);
  return std::nullopt;
}

std::optional<bool> ReadFlag(const YamlNode& node, const std::string& path, Problems& problems) {
  if (node.is_scalar() && KindOf(node) == ScalarKind::kBool) {
    return node.text.front() == 't' || node.text.front() == 'T';
  }
  Expected(node, path, "true or false", problems);
  return std::nullopt;
}

std::optional<std::string> ReadText(const YamlNode& node, const std::string& path,
                                    Problems& problems) {
  if (node.is_scalar() && KindOf(node) == ScalarKind::kText) return node.text;
  Expected(node, path, node.is_scalar() ? "text (in quotes, if it looks like a number)" : "text",
           problems);
  return std::nullopt;
}

bool IsName(const std::string& name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto good = [&letter](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  constexpr std::size_t kLongest = 64;  // it becomes part of file names
  return !name.empty() && name.size() <= kLongest && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), good);
}

std::string NumberText(double value) {
  std::array<char, 64> buffer{};
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-3 && size < 1e9);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
  return {buffer.data(), end};
}

}  // namespace reckon::harness
