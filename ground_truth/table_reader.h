#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "reckon/ground_truth/column.h"
#include "reckon/ground_truth/hdf5_handle.h"

namespace reckon::ground_truth {

/// Reads one packed row, column after column.
class RowDecoder {
 public:
  explicit RowDecoder(const std::byte* at) : at_(at) {}

  template <class T>
  T Get() {
    T number;
    std::memcpy(&number, at_, sizeof(T));
    at_ += sizeof(T);
    return number;
  }
  bool Flag() { return Get<std::uint8_t>() != 0; }
  Eigen::Vector3d Vector() {
    Eigen::Vector3d vector;
    for (int i = 0; i < 3; ++i) vector[i] = Get<double>();
    return vector;
  }
  Eigen::Matrix3d Matrix() {
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 3; ++i) matrix.row(i) = Vector().transpose();
    return matrix;
  }
  /// A symmetric matrix from one triangle, as RowEncoder::PutSymmetric wrote it.
  template <class Symmetric>
  void GetSymmetric(Symmetric& matrix) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      for (Eigen::Index i = j; i < matrix.rows(); ++i) matrix(i, j) = matrix(j, i) = Get<double>();
    }
  }

 private:
  const std::byte* at_;
};

/// Reads a table from its first row to its last, a block of rows at a time: flat memory.
class TableReader {
 public:
  /// Opens the dataset `name`. Throws RecordingError if it is missing or its columns are not
  /// `columns` (or, for a matrix, its width is not `width`).
  TableReader(hid_t file, const std::filesystem::path& path, const std::string& name,
              const Columns& columns, std::size_t width = 0);

  /// The next row; null after the last. It lives until the next call.
  const std::byte* Next();

  /// Where the row that `Next` gave last is: file, table and number.
  std::string Place() const;

 private:
  void ReadBlock();

  std::filesystem::path path_;
  std::string name_;
  Hdf5Handle dataset_;
  std::size_t row_bytes_ = 0, width_ = 0, rows_ = 0, next_ = 0;
  std::size_t block_first_ = 0, block_rows_ = 0;
  std::vector<std::byte> block_;
};

}  // namespace reckon::ground_truth
