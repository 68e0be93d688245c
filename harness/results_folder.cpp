#include "reckon/harness/results_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;

/// `write(2)` to the end, with the reason when it fails: streams hide what a full disk says.
void WriteBytes(const fs::path& path, std::string_view text) {
  std::FILE* file = std::fopen(path.c_str(), "wbe");
  if (file == nullptr) {
    throw OutputError(fmt::format("can't write {}: {}", path.string(), std::strerror(errno)));
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) {
    throw OutputError(fmt::format("can't write {}: {}", path.string(),
                                  std::strerror(written ? errno : write_error)));
  }
}

/// A name beside `final_folder` that no other run uses, on this thread or in another process.
/// Who may read it is the umask's to say, as for every file in it (mkdtemp would shut all out).
fs::path PartName(const fs::path& final_folder) {
  constexpr int kTries = 100;
  std::random_device random;
  std::error_code error;
  for (int i = 0; i < kTries; ++i) {
    fs::path name = fmt::format("{}.part.{:06x}", final_folder.string(), random() & 0xffffff);
    if (fs::create_directory(name, error)) return name;
    if (error) break;
  }
  throw OutputRefused(fmt::format("can't make a folder beside {}: {}", final_folder.string(),
                                  error ? error.message() : "all names are taken"));
}

}  // namespace

bool IsFinishedResult(const fs::path& folder, const std::string& scenario, std::uint64_t seed) {
  std::ifstream file(folder / "run.json");
  if (!file) return false;
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("scenario") || !json.contains("seed")) return false;
  return json["scenario"] == scenario && json["seed"] == seed;
}

ResultsFolder::ResultsFolder(fs::path final_folder, std::string scenario, std::uint64_t seed,
                             bool force)
    : final_(std::move(final_folder)) {
  std::error_code error;
  fs::create_directories(final_.parent_path(), error);
  if (error) {
    throw OutputRefused(
        fmt::format("can't make {}: {}", final_.parent_path().string(), error.message()));
  }
  const bool occupied = fs::exists(final_) && !fs::is_empty(final_, error);
  if (occupied && !force && !IsFinishedResult(final_, scenario, seed)) {
    throw OutputRefused(
        fmt::format("{} exists and is not a finished result of {} with seed {}; "
                    "move it away, choose another --out, or use --force",
                    final_.string(), scenario, seed));
  }
  part_ = PartName(final_);
}

ResultsFolder::~ResultsFolder() {
  if (published_) return;
  std::error_code ignored;
  fs::remove_all(part_, ignored);
}

void ResultsFolder::Write(std::string_view name, std::string_view text) const {
  WriteBytes(File(name), text);
}

void ResultsFolder::Publish() {
  std::error_code error;
  const fs::path old = part_.string() + ".old";
  const bool replaces = fs::exists(final_);
  if (replaces) fs::rename(final_, old, error);
  const bool moved = replaces && !error;
  if (!error) fs::rename(part_, final_, error);
  if (error) {
    std::error_code ignored;
    if (moved) fs::rename(old, final_, ignored);
    throw OutputError(
        fmt::format("can't rename {} to {}: {}", part_.string(), final_.string(), error.message()));
  }
  published_ = true;
  if (replaces) fs::remove_all(old, error);
}

ReplacementFiles::ReplacementFiles(fs::path folder)
    : final_(std::move(folder)), part_(PartName(final_ / "scores")) {}

ReplacementFiles::~ReplacementFiles() {
  std::error_code ignored;
  fs::remove_all(part_, ignored);
}

void ReplacementFiles::Write(std::string_view name, std::string_view text) const {
  WriteBytes(part_ / name, text);
}

void ReplacementFiles::Publish() {
  std::error_code error;
  for (const auto& file : fs::directory_iterator(part_)) {
    fs::rename(file.path(), final_ / file.path().filename(), error);
    if (error) {
      throw OutputError(fmt::format("can't rename {} to {}: {}", file.path().string(),
                                    final_.string(), error.message()));
    }
  }
}

}  // namespace reckon::harness
