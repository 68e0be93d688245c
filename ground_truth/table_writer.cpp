#include "reckon/ground_truth/table_writer.h"

#include <algorithm>

namespace reckon::ground_truth {
namespace {

hid_t FileType(ColumnType type) {
  switch (type) {
    case ColumnType::kFloat64:
      return H5T_IEEE_F64LE;
    case ColumnType::kInt64:
      return H5T_STD_I64LE;
    case ColumnType::kUint64:
      return H5T_STD_U64LE;
    case ColumnType::kUint16:
      return H5T_STD_U16LE;
    case ColumnType::kUint8:
      return H5T_STD_U8LE;
  }
  return H5I_INVALID_HID;
}

Hdf5Handle RowType(const Columns& columns) {
  Hdf5Handle type(H5Tcreate(H5T_COMPOUND, RowBytes(columns)), H5Tclose);
  std::size_t offset = 0;
  for (const Column& column : columns) {
    H5Tinsert(type.get(), column.name.c_str(), offset, FileType(column.type));
    offset += Size(column.type);
  }
  return type;
}

void DescribeColumns(hid_t dataset, const Columns& columns) {
  std::vector<std::string> units, frames, descriptions;
  for (const Column& column : columns) {
    units.push_back(column.unit);
    frames.push_back(column.frame);
    descriptions.push_back(column.description);
  }
  WriteAttribute(dataset, "units", units);
  WriteAttribute(dataset, "frames", frames);
  WriteAttribute(dataset, "descriptions", descriptions);
}

}  // namespace

TableWriter::TableWriter(hid_t file, const std::filesystem::path& path, const std::string& name,
                         const Columns& columns, std::size_t chunk_rows, std::size_t width)
    : path_(path),
      row_bytes_(width > 0 ? width * sizeof(double) : RowBytes(columns)),
      chunk_rows_(chunk_rows),
      matrix_(width > 0),
      width_(width),
      buffer_(row_bytes_ * chunk_rows) {
  const hsize_t none[2] = {0, width_}, most[2] = {H5S_UNLIMITED, width_};
  const hsize_t chunk[2] = {chunk_rows_, width_};
  const int rank = matrix_ ? 2 : 1;
  const Hdf5Handle space(H5Screate_simple(rank, none, most), H5Sclose);
  const Hdf5Handle type =
      matrix_ ? Hdf5Handle(H5Tcopy(H5T_IEEE_F64LE), H5Tclose) : RowType(columns);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties.get(), rank, chunk);
  H5Pset_obj_track_times(properties.get(), false);
  H5Pset_fill_time(properties.get(), H5D_FILL_TIME_NEVER);
  dataset_ = Own(H5Dcreate2(file, name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                            properties.get(), H5P_DEFAULT),
                 H5Dclose, path_, "can't make " + name);
  if (!matrix_) DescribeColumns(dataset_.get(), columns);
}

void TableWriter::Flush() {
  if (waiting_ == 0) return;
  const Hdf5Quiet quiet;
  std::fill(buffer_.begin() + static_cast<std::ptrdiff_t>(waiting_ * row_bytes_), buffer_.end(),
            std::byte{0});
  const hsize_t extent[2] = {written_ + waiting_, width_}, offset[2] = {written_, 0};
  if (H5Dset_extent(dataset_.get(), extent) < 0 ||
      H5Dwrite_chunk(dataset_.get(), H5P_DEFAULT, 0, offset, buffer_.size(), buffer_.data()) < 0 ||
      H5Dflush(dataset_.get()) < 0) {
    failed_ = true;
    ThrowHdf5(path_, "can't write");
  }
  written_ += waiting_;
  waiting_ = 0;
}

}  // namespace reckon::ground_truth
