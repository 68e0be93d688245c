#include "reckon/ground_truth/hdf5_handle.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <string_view>
#include <vector>

#include "reckon/ground_truth/run_recorder.h"

namespace reckon::ground_truth {
namespace {

/// At exit the library would close what is open once more, and crashes over a file that it could
/// not write to its end. We close what we open. This must come before any other call of HDF5.
const herr_t kNoCleanupAtExit = H5dont_atexit();

/// Keeps the first description, which is the innermost when the stack is walked upwards.
herr_t KeepFirst(unsigned n, const H5E_error2_t* error, void* text) {
  if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// The system's words inside a description of HDF5, which also holds times and addresses.
std::string Reason(const std::string& description) {
  constexpr std::string_view kMark = "error message = '";
  const auto begin = description.find(kMark);
  if (begin == std::string::npos) return description.empty() ? "unknown error" : description;
  const auto from = begin + kMark.size();
  return description.substr(from, description.find('\'', from) - from);
}

void Write(hid_t object, const std::string& name, hid_t type, const Hdf5Handle& space,
           const void* data) {
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute.get() < 0 || H5Awrite(attribute.get(), type, data) < 0) {
    ThrowHdf5(name, "can't write attribute");
  }
}

Hdf5Handle TextType() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle Vector(std::size_t size) {
  const hsize_t extent = size;
  return {H5Screate_simple(1, &extent, nullptr), H5Sclose};
}

}  // namespace

void ThrowHdf5(const std::filesystem::path& path, const std::string& action) {
  std::string description;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, KeepFirst, &description);
  throw RecordingError(fmt::format("{}: {}: {}", path.string(), action, Reason(description)));
}

Hdf5Handle Own(hid_t id, Hdf5Handle::Closer close, const std::filesystem::path& path,
               const std::string& action) {
  if (id < 0) ThrowHdf5(path, action);
  return {id, close};
}

void DivertFile(hid_t file) {
  void* handle = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0) return;
  const int memory = memfd_create("reckon recording", MFD_CLOEXEC);
  if (memory < 0) return;
  dup2(memory, *static_cast<int*>(handle));  // the default driver's handle is its descriptor
  close(memory);
}

void WriteAttribute(hid_t object, const std::string& name, const std::string& text) {
  const char* data = text.c_str();
  Write(object, name, TextType().get(), {H5Screate(H5S_SCALAR), H5Sclose}, &data);
}

void WriteAttribute(hid_t object, const std::string& name, const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  std::vector<const char*> data;
  data.reserve(texts.size());
  for (const auto& text : texts) data.push_back(text.c_str());
  Write(object, name, TextType().get(), Vector(data.size()), data.data());
}

void WriteAttribute(hid_t object, const std::string& name, const std::vector<double>& numbers) {
  if (numbers.empty()) return;
  const hsize_t extent = numbers.size();
  const Hdf5Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (attribute.get() < 0 || H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, numbers.data()) < 0) {
    ThrowHdf5(name, "can't write attribute");
  }
}

}  // namespace reckon::ground_truth
