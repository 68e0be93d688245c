#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace reckon::harness {

/// Edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`.
int EditDistance(std::string_view a, std::string_view b);

/// The name that someone who wrote `word` most likely meant: the one with the fewest edits, if
/// these are at most a third of the longer word's letters. The first of several; nothing if none is
/// near.
std::optional<std::string> Nearest(std::string_view word, std::span<const std::string> names);

/// `; did you mean 'x'?`, or nothing.
std::string DidYouMean(std::string_view word, std::span<const std::string> names);

}  // namespace reckon::harness
