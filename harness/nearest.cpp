#include "reckon/harness/nearest.h"

#include <algorithm>
#include <vector>

namespace reckon::harness {

int EditDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment: three rows of the dynamic programme.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::optional<std::string> Nearest(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t kLongestName = 200;  // the distance costs the product of both lengths
  if (word.size() > kLongestName) return std::nullopt;
  std::optional<std::string> nearest;
  int fewest = 0;
  for (const std::string& name : names) {
    const int edits = EditDistance(word, name);
    const int allowed = std::max<int>(1, static_cast<int>(std::max(word.size(), name.size()) / 3));
    if (edits > allowed || (nearest && edits >= fewest)) continue;
    nearest = name;
    fewest = edits;
  }
  return nearest;
}

std::string DidYouMean(std::string_view word, std::span<const std::string> names) {
  const auto nearest = Nearest(word, names);
  return nearest ? "; did you mean '" + *nearest + "'?" : std::string();
}

}  // namespace reckon::harness
