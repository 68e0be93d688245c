#include "reckon/harness/yaml_error.h"

#include <algorithm>

namespace reckon::harness {

std::string Location::Text() const {
  std::string text = source ? *source : std::string("scenario");
  if (line > 0) text += ":" + std::to_string(line) + ":" + std::to_string(column);
  return text;
}

void Problems::Add(const Location& where, const std::string& what) {
  const std::string line = where.Text() + ": error: " + what;
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
}

void Problems::ThrowIfAny() const {
  constexpr std::size_t kMostLines = 20;
  if (lines_.empty()) return;
  std::string all;
  for (std::size_t i = 0; i < std::min(lines_.size(), kMostLines); ++i) {
    all += (i == 0 ? "" : "\n") + lines_[i];
  }
  if (lines_.size() > kMostLines) {
    all += "\n… and " + std::to_string(lines_.size() - kMostLines) + " more";
  }
  throw InputError(all);
}

void Fail(const Location& where, const std::string& what) {
  throw InputError(where.Text() + ": error: " + what);
}

}  // namespace reckon::harness
