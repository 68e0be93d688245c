#include "reckon/ground_truth/table_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/ground_truth/run_recorder.h"

namespace reckon::ground_truth {
namespace {

constexpr std::size_t kBlockRows = 1024;

void CheckColumns(hid_t type, const std::filesystem::path& path, const std::string& name,
                  const Columns& columns) {
  const int found = H5Tget_nmembers(type);
  bool same = found == static_cast<int>(columns.size()) && H5Tget_size(type) == RowBytes(columns);
  for (int i = 0; same && i < found; ++i) {
    char* const column = H5Tget_member_name(type, static_cast<unsigned>(i));
    same = column != nullptr && columns[static_cast<std::size_t>(i)].name == column;
    H5free_memory(column);
  }
  if (!same) {
    throw RecordingError(
        fmt::format("{}: {} does not have the columns of this version", path.string(), name));
  }
}

}  // namespace

TableReader::TableReader(hid_t file, const std::filesystem::path& path, const std::string& name,
                         const Columns& columns, std::size_t width)
    : path_(path),
      name_(name),
      row_bytes_(width > 0 ? width * sizeof(double) : RowBytes(columns)),
      width_(width) {
  const Hdf5Quiet quiet;
  dataset_ = Own(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, path_, "can't read " + name);
  const Hdf5Handle type(H5Dget_type(dataset_.get()), H5Tclose);
  if (width_ == 0) CheckColumns(type.get(), path_, name_, columns);
  const Hdf5Handle space(H5Dget_space(dataset_.get()), H5Sclose);
  hsize_t extent[2] = {0, 0};
  const int rank = H5Sget_simple_extent_dims(space.get(), extent, nullptr);
  if (rank != (width_ > 0 ? 2 : 1) || extent[1] != width_) {
    throw RecordingError(fmt::format("{}: {} has the wrong shape", path_.string(), name_));
  }
  rows_ = extent[0];
}

const std::byte* TableReader::Next() {
  if (next_ >= rows_) return nullptr;
  if (next_ >= block_first_ + block_rows_) ReadBlock();
  return block_.data() + (next_++ - block_first_) * row_bytes_;
}

std::string TableReader::Place() const {
  return fmt::format("{}: {}, row {}", path_.string(), name_, next_ - 1);
}

void TableReader::ReadBlock() {
  const Hdf5Quiet quiet;
  block_first_ = next_;
  block_rows_ = std::min(kBlockRows, rows_ - next_);
  block_.resize(block_rows_ * row_bytes_);
  const hsize_t start[2] = {block_first_, 0}, count[2] = {block_rows_, width_};
  const Hdf5Handle type(H5Dget_type(dataset_.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset_.get()), H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(width_ > 0 ? 2 : 1, count, nullptr), H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  if (H5Dread(dataset_.get(), type.get(), memory.get(), space.get(), H5P_DEFAULT, block_.data()) <
      0) {
    ThrowHdf5(path_, "can't read " + name_);
  }
}

}  // namespace reckon::ground_truth
