#include "reckon/harness/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace reckon::harness {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{100};
constexpr std::chrono::milliseconds kLogPeriod{3000};
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { Clear(); }

void Progress::Update(const std::string& run, double fraction, double real_time_factor) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? kTerminalPeriod : kLogPeriod)) return;
  last_ = now;
  if (!terminal_) {
    fmt::print(stderr, "{}: {:.0f} %, {:.0f} times real time\n", run, 100.0 * fraction,
               real_time_factor);
    return;
  }
  const int filled = static_cast<int>(fraction * kBarWidth);
  fmt::print(stderr, "\r\x1b[K{} [{:=<{}}{: <{}}] {:3.0f} % {:.0f}x", run, "", filled, "",
             kBarWidth - filled, 100.0 * fraction, real_time_factor);
  std::fflush(stderr);
  line_open_ = true;
}

void Progress::Clear() {
  const std::scoped_lock lock(mutex_);
  if (line_open_) fmt::print(stderr, "\r\x1b[K");
  line_open_ = false;
}

}  // namespace reckon::harness
