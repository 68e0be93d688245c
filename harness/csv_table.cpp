#include "reckon/harness/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "reckon/harness/nearest.h"
#include "reckon/harness/yaml_node.h"

namespace reckon::harness {
namespace {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return text.substr(0, 0);  // it keeps its place
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

void Split(std::string_view line, std::vector<std::string_view>& values) {
  values.clear();
  for (;;) {
    const auto comma = line.find(',');
    values.push_back(Trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// The whole of `text` as a number.
template <class T>
bool Parse(std::string_view text, T& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// Seconds with decimals, digit by digit: binary fractions would lose nanoseconds of an epoch time.
bool ParseSeconds(std::string_view text, models::TimeNs& ns) {
  constexpr std::size_t kDigits = 9;
  if (text.find_first_of("eE") != std::string_view::npos) {  // 5e-05: only small ones look so
    double seconds = -1.0;
    ns = Parse(text, seconds) && seconds >= 0.0 && seconds < 1e6 ? std::llround(1e9 * seconds) : -1;
    return ns >= 0;
  }
  const auto point = text.find('.');
  std::string_view fraction;
  if (point != std::string_view::npos) fraction = text.substr(point + 1);
  models::TimeNs whole = 0, part = 0;
  if (!Parse(text.substr(0, point), whole)) return false;
  std::string digits(fraction.substr(0, kDigits));
  if (fraction.find_first_not_of("0123456789") != std::string_view::npos) return false;
  digits.resize(kDigits, '0');
  (void)Parse(digits, part);
  constexpr models::TimeNs kMost =
      std::numeric_limits<models::TimeNs>::max() / models::kNsPerSecond;
  if (whole < 0 || whole >= kMost) return false;
  ns = whole * models::kNsPerSecond + part;
  return true;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path)
    : file_(path), name_(std::make_shared<const std::string>(path.string())) {
  if (!file_) Fail({name_, 0, 0}, "can't read this file");
  if (!ReadLine()) Fail({name_, 0, 0}, "expected a header with the names of its columns");
  Split(text_, values_);
  for (const std::string_view name : values_) {
    if (Find(name)) Fail({name_, line_, 1}, "the column '" + Shown(name) + "' stands twice");
    columns_.emplace_back(name);
  }
}

bool CsvTable::ReadLine() {
  while (std::getline(file_, text_)) {
    ++line_;
    const std::string_view line = Trimmed(text_);
    if (!line.empty() && line.front() != '#') return true;
  }
  return false;
}

std::optional<std::size_t> CsvTable::Find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::Need(const std::string& column) const {
  if (const auto place = Find(column)) return *place;
  Fail({name_, 1, 1}, "there is no column '" + column + "'" + DidYouMean(column, columns_));
}

bool CsvTable::Next() {
  if (!ReadLine()) return false;
  Split(text_, values_);
  if (values_.size() == columns_.size()) return true;
  Fail({name_, line_, 1}, "expected " + std::to_string(columns_.size()) + " values, found " +
                              std::to_string(values_.size()));
}

void CsvTable::Refuse(std::size_t column, const std::string& expected) const {
  const auto place = static_cast<int>(values_[column].data() - text_.data()) + 1;
  Fail({name_, line_, place}, "'" + columns_[column] + "': expected " + expected + ", found '" +
                                  Shown(values_[column]) + "'");
}

double CsvTable::Number(std::size_t column) const {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (!values_[column].empty() && !Parse(values_[column], value)) Refuse(column, "a number");
  return value;
}

models::TimeNs CsvTable::Time(std::size_t column, bool in_seconds) const {
  models::TimeNs ns = 0;
  const bool good =
      in_seconds ? ParseSeconds(values_[column], ns) : Parse(values_[column], ns) && ns >= 0;
  if (!good)
    Refuse(column, in_seconds ? "seconds of at least 0" : "whole nanoseconds of at least 0");
  return ns;
}

}  // namespace reckon::harness
