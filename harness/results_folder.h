#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace reckon::harness {

/// A result can't be written: the disk is full, or a file can't be made.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The output folder that was asked for can't be used: it is not ours, or can't be made.
class OutputRefused : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A result folder while it is being written. Everything goes into a folder beside the final name;
/// `Publish` renames it when it is whole. What was never published is removed, so that nothing that
/// looks finished is left behind.
class ResultsFolder {
 public:
  /// Makes the working folder beside `final_folder`. An existing final folder is replaced at
  /// `Publish` if it is a finished result of `scenario` and `seed`, or if `force` is set; otherwise
  /// this throws OutputRefused, before anything is written.
  ResultsFolder(std::filesystem::path final_folder, std::string scenario, std::uint64_t seed,
                bool force);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// The path of a file in the working folder.
  std::filesystem::path File(std::string_view name) const { return part_ / name; }
  const std::filesystem::path& final_folder() const { return final_; }

  /// Writes a whole text file into the working folder. Throws OutputError.
  void Write(std::string_view name, std::string_view text) const;

  /// Gives the folder its final name. Throws OutputError; then what was there before still is.
  void Publish();

 private:
  std::filesystem::path final_, part_;
  bool published_ = false;
};

/// Files that replace those of a finished result together: they are written into a folder inside
/// it, and `Publish` renames them into place once all are whole. Without it, nothing has changed.
class ReplacementFiles {
 public:
  /// Throws OutputRefused if nothing can be written into `folder`.
  explicit ReplacementFiles(std::filesystem::path folder);
  ~ReplacementFiles();
  ReplacementFiles(const ReplacementFiles&) = delete;
  ReplacementFiles& operator=(const ReplacementFiles&) = delete;

  const std::filesystem::path& folder() const { return part_; }

  /// Throws OutputError.
  void Write(std::string_view name, std::string_view text) const;
  void Publish();

 private:
  std::filesystem::path final_, part_;
};

/// Whether `folder` holds a finished result of this scenario and seed.
bool IsFinishedResult(const std::filesystem::path& folder, const std::string& scenario,
                      std::uint64_t seed);

}  // namespace reckon::harness
