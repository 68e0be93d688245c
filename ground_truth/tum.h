#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/models/time.h"

namespace reckon::ground_truth {

/// A pose with its stamp.
struct StampedPose {
  models::TimeNs t_ns = 0;
  models::Pose X_WB;
};

/// Writes a trajectory as text, one pose a line: `t tx ty tz qx qy qz qw`, seconds with nine
/// decimals, numbers with as many digits as it takes to read them back exactly, q of R_WB with
/// qw ≥ 0. No header: any reader of the format takes it. Throws RecordingError.
class TumWriter {
 public:
  explicit TumWriter(const std::filesystem::path& path);
  ~TumWriter();
  TumWriter(TumWriter&&) noexcept;
  TumWriter& operator=(TumWriter&&) noexcept;

  void Add(models::TimeNs t_ns, const models::Pose& X_WB);

  /// Writes what is left and closes.
  void Close();

 private:
  void Flush();

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  fmt::memory_buffer text_;
};

/// Reads such a file; lines that start with # are comments. Stamps are rounded to nanoseconds and
/// quaternions normalised. Throws RecordingError, which names file and line.
std::vector<StampedPose> ReadTum(const std::filesystem::path& path);

}  // namespace reckon::ground_truth
