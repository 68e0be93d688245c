#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/harness/yaml_error.h"
#include "reckon/models/time.h"

namespace reckon::harness {

/// Numbers in columns with names: a header line, then one row a line, comma-separated, read one row
/// at a time. Spaces around a value, empty lines and lines that begin with `#` do not count. An
/// empty value is not a number (NaN).
class CsvTable {
 public:
  /// Throws InputError if the file can't be read, or has no header or a column twice.
  explicit CsvTable(const std::filesystem::path& path);

  /// The place of a column; nothing if there is none.
  std::optional<std::size_t> Find(std::string_view column) const;

  /// Its place; throws InputError, with the nearest name, if there is none.
  std::size_t Need(const std::string& column) const;

  /// Goes to the next row; false after the last. Throws InputError for a row with more or fewer
  /// values than the header.
  bool Next();

  /// A value of this row. Throws InputError for what is no number.
  double Number(std::size_t column) const;

  /// A time of this row [ns], exact to the last digit: the column is in whole nanoseconds, or in
  /// seconds. Throws InputError for what is no time.
  models::TimeNs Time(std::size_t column, bool in_seconds) const;

 private:
  [[noreturn]] void Refuse(std::size_t column, const std::string& expected) const;
  bool ReadLine();

  std::ifstream file_;
  std::shared_ptr<const std::string> name_;
  int line_ = 0;
  std::string text_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> values_;  ///< of `text_`
};

}  // namespace reckon::harness
