#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace reckon::ground_truth {

/// Owns one HDF5 identifier and the function that gives it back.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Closer close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { (void)Close(); }

  hid_t get() const { return id_; }

  /// Gives the identifier back now; whether HDF5 could.
  bool Close() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer close_ = nullptr;
};

/// Keeps HDF5 from printing its error stack for as long as it lives (on this thread).
class Hdf5Quiet {
 public:
  Hdf5Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Throws RecordingError: `path`, what could not be done, and the innermost reason that HDF5 knows
/// (the operating system's, if it was the one that refused).
[[noreturn]] void ThrowHdf5(const std::filesystem::path& path, const std::string& action);

/// `id`, or ThrowHdf5 if it is not valid.
Hdf5Handle Own(hid_t id, Hdf5Handle::Closer close, const std::filesystem::path& path,
               const std::string& action);

/// Lets everything that HDF5 still writes to `file` go to memory instead. HDF5 can't close a file
/// that it can't write to: it would keep the disk's space and crash at the end of the process.
void DivertFile(hid_t file);

/// Texts as attributes of a file, group or dataset: variable-length UTF-8.
void WriteAttribute(hid_t object, const std::string& name, const std::string& text);
void WriteAttribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);
void WriteAttribute(hid_t object, const std::string& name, const std::vector<double>& numbers);

}  // namespace reckon::ground_truth
