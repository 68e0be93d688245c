#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reckon::harness {

/// A command can't be started: no such program, no such folder, not executable.
class ProcessStartError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Owns a file descriptor.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() { Close(); }

  void Close() noexcept;
  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// A program that answers lines with lines, over pipes. It leads a process group of its own: Ctrl-C
/// at the terminal doesn't reach it, and what it starts ends with it. Not thread-safe.
class ChildProcess {
 public:
  /// Starts `command` (the program, looked up in PATH, and its arguments) in `working_folder`. A
  /// program that is a path is relative to that folder. Throws ProcessStartError.
  ChildProcess(const std::vector<std::string>& command,
               const std::filesystem::path& working_folder);
  ~ChildProcess() { End(std::chrono::seconds(1)); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class Outcome {
    kLine,     ///< `text` is the answer, without its newline
    kTimeout,  ///< `text` is the part of a line that came
    kClosed,   ///< it ended or closed its output; `text` is the part of a line that came
    kUnasked,  ///< it spoke before it was asked; `text` is what it said
    kTooLong,  ///< a line beyond `kLongestLine`; `text` is its beginning
    kStopped,  ///< `stop` turned true; `text` is the part of a line that came
  };
  struct Answer {
    Outcome outcome = Outcome::kLine;
    std::string text;
  };
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  /// Sends `text` and waits for one line. Reads while it writes, so that full pipes can't lock
  /// both. `stop` (it may be null) ends the wait within a tenth of a second of turning true.
  Answer Exchange(std::string_view text, std::chrono::nanoseconds timeout,
                  const std::atomic<bool>* stop = nullptr);

  /// Closes the child's input and gives it `grace` to leave; then SIGTERM, then SIGKILL. No process
  /// of its group is left, no zombie either. Harmless if it has ended.
  void End(std::chrono::milliseconds grace) noexcept;

  /// How it ended ("exit code 3", "signal 11 (Segmentation fault)"); empty before `End`.
  const std::string& ending() const { return ending_; }
  /// Its last lines of standard error, each cut to a readable length.
  std::string LastErrors() const;
  pid_t pid() const { return pid_; }

 private:
  using Clock = std::chrono::steady_clock;

  void Send(std::string_view& unsent);
  void ReadOutput();
  void ReadErrors();
  bool Wait(Clock::time_point deadline, std::chrono::milliseconds longest, bool writable);
  bool HasEnded() const noexcept;
  bool WaitForEnd(std::chrono::milliseconds grace) noexcept;

  Descriptor input_, output_, errors_;   // our ends
  std::string received_;                 // of its output, not yet taken
  std::deque<std::string> error_lines_;  // the last one may still grow
  pid_t pid_ = -1;
  std::string ending_;
};

}  // namespace reckon::harness
