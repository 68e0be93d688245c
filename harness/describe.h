#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>

namespace reckon::harness {

// How a struct of the scenario is described: one function
//     template <class Archive> void Describe(Archive& a, T& value)
// lists its keys with a sentence, bounds and the member behind each. Three archives run it: one
// reads YAML, one writes it, one builds the JSON Schema. An archive offers
//
//   a.Field(key, member, doc, limits, need)     number, flag, word, text, list, map or struct
//   a.Kind(key, member, choices, doc, need)     the word that says which of the other keys count
//   a.Word(key, text, choices, doc)             a word of a table that is known at run time only
//   a.Group(key, doc, [](auto& sub) {…})        a nested map without a struct of its own
//   a.WordOr(key, word, choices, given, member, doc)   one of some words, or a map (then `given`)
//   a.Map(key, map, prototype, doc)             a map of structs that start as copies of
//   `prototype` a.Removable(key, map, doc)                  a map whose entries can be written
//   `off` a.Rest(map, doc)                            all further keys are entries of this map
//   a.Directive(key, doc)                       a key that was dealt with when the file was loaded
//
// Keys that only some kinds have stand behind a plain `if` after a.Kind. Archive::kWrites is true
// for the archive that writes, kListsAll for one that has no values and wants every key.

/// The numbers that a field takes; they hold for each entry of a list.
struct Limits {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;  ///< `min` itself is outside
};

constexpr Limits AtLeast(double min) { return {.min = min}; }
constexpr Limits Above(double min) { return {.min = min, .above_min = true}; }
constexpr Limits Between(double min, double max) { return {.min = min, .max = max}; }
constexpr Limits AboveUpTo(double min, double max) {
  return {.min = min, .max = max, .above_min = true};
}

/// Whether a key must be written.
enum class Need : std::uint8_t {
  kOptional,
  kSomewhere,  ///< in the file, or in what it includes, or in the robot's own suite
  kHere,       ///< in the file
};

/// One word that a field can take.
template <class T>
struct Choice {
  T value;
  std::string name;
  std::string doc;
};

/// The words of an enumeration, in the order of `reckon list`.
template <class T>
std::span<const Choice<T>> Choices();

/// `a`, `b` or `c`, for messages.
template <class T>
std::string JoinNames(std::span<const Choice<T>> choices) {
  std::string joined;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) joined += i + 1 == choices.size() ? " or " : ", ";
    joined += choices[i].name;
  }
  return joined;
}

/// A type that is written as one line of text (a comparison): specialise with
///     static T Read(const std::string&)  (throws std::invalid_argument: what was expected)
///     static std::string Write(const T&)
template <class T>
struct TextForm {
  static constexpr bool kExists = false;
};

}  // namespace reckon::harness
