#pragma once

#include <Eigen/Core>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "reckon/ground_truth/column.h"
#include "reckon/ground_truth/hdf5_handle.h"

namespace reckon::ground_truth {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

/// Fills one packed row, column after column.
class RowEncoder {
 public:
  explicit RowEncoder(std::byte* at) : at_(at) {}

  template <class T>
  void Put(T number) {
    static_assert(std::is_arithmetic_v<T>);
    std::memcpy(at_, &number, sizeof(T));
    at_ += sizeof(T);
  }
  void Put(bool flag) { Put(static_cast<std::uint8_t>(flag)); }
  void Put(const Eigen::Vector3d& vector) {
    for (int i = 0; i < 3; ++i) Put(vector[i]);
  }
  /// Row by row.
  void Put(const Eigen::Matrix3d& matrix) {
    for (int i = 0; i < 3; ++i) Put(Eigen::Vector3d(matrix.row(i)));
  }
  /// A symmetric matrix: its upper triangle row by row, taken from the lower one column by column.
  template <class Symmetric>
  void PutSymmetric(const Symmetric& matrix) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const std::size_t bytes = static_cast<std::size_t>(matrix.rows() - j) * sizeof(double);
      std::memcpy(at_, &matrix.coeffRef(j, j), bytes);
      at_ += bytes;
    }
  }

  const std::byte* at() const { return at_; }

 private:
  std::byte* at_;
};

/// One dataset that grows by rows: a compound of scalar columns, or a matrix of float64.
/// Rows wait in a buffer until they fill a chunk, which is then written past HDF5's own chunk cache
/// and flushed. Appending does not allocate.
class TableWriter {
 public:
  /// Makes the dataset `name` (its groups must exist). `width` > 0 makes a matrix of that many
  /// columns instead of a compound. Throws RecordingError.
  TableWriter(hid_t file, const std::filesystem::path& path, const std::string& name,
              const Columns& columns, std::size_t chunk_rows, std::size_t width = 0);

  /// Appends the row that `fill(RowEncoder&)` writes.
  template <class Fill>
  void Append(Fill&& fill) {
    std::byte* const begin = buffer_.data() + waiting_ * row_bytes_;
    RowEncoder row(begin);
    fill(row);
    assert(row.at() == begin + row_bytes_);
    if (++waiting_ == chunk_rows_) Flush();
  }

  /// Writes the waiting rows and makes them readable from outside. Between two calls from outside
  /// only whole chunks are written; more rows may follow only after a whole chunk.
  void Flush();

  /// Whether a write failed: the file is then of no more use.
  bool failed() const { return failed_; }

  hid_t dataset() const { return dataset_.get(); }
  bool Close() { return dataset_.Close(); }

 private:
  std::filesystem::path path_;
  Hdf5Handle dataset_;
  std::size_t row_bytes_, chunk_rows_;
  bool matrix_;
  bool failed_ = false;
  hsize_t width_, written_ = 0;
  std::size_t waiting_ = 0;
  std::vector<std::byte> buffer_;
};

}  // namespace reckon::ground_truth
