#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace reckon::harness {

/// Progress on stderr: on a terminal one line that is rewritten at most ten times a second,
/// elsewhere a line every few seconds. Safe to call from several runs at once.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of `run` is done, at `real_time_factor` times real time.
  void Update(const std::string& run, double fraction, double real_time_factor);

  /// Ends the line on a terminal, so that what is printed next starts clean.
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  bool quiet_, terminal_;
  bool line_open_ = false;
  Clock::time_point last_ = Clock::now();
};

}  // namespace reckon::harness
