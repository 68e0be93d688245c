#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace reckon::ground_truth {

/// How one number of a row is stored, little-endian.
enum class ColumnType : std::uint8_t { kFloat64, kInt64, kUint64, kUint16, kUint8 };

/// One scalar column of a recorded table. Rows are packed: a column starts where the last one ends.
struct Column {
  std::string name;
  ColumnType type = ColumnType::kFloat64;
  std::string unit, frame, description;
};

using Columns = std::vector<Column>;

/// Bytes of one number.
constexpr std::size_t Size(ColumnType type) {
  switch (type) {
    case ColumnType::kUint16:
      return 2;
    case ColumnType::kUint8:
      return 1;
    default:
      return 8;
  }
}

/// Bytes of one packed row.
inline std::size_t RowBytes(const Columns& columns) {
  std::size_t bytes = 0;
  for (const Column& column : columns) bytes += Size(column.type);
  return bytes;
}

}  // namespace reckon::ground_truth
