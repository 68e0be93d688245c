#pragma once

#include <string>

#include "reckon/harness/describe.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// Comparisons are written as one line: `a.metric < b.metric` or `a.metric > 0.8 * b.metric`.
template <>
struct TextForm<Comparison> {
  static constexpr bool kExists = true;
  static constexpr const char* kPattern =
      R"(^\s*[\w-]+\.\S+\s*[<>]\s*([0-9.eE+-]+\s*\*\s*)?[\w-]+\.\S+\s*$)";
  /// Throws std::invalid_argument with what was expected.
  static Comparison Read(const std::string& text);
  static std::string Write(const Comparison& comparison) { return comparison.text; }
};

}  // namespace reckon::harness
