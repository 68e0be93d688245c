#include "reckon/harness/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <system_error>

namespace reckon::harness {
namespace {

constexpr std::size_t kErrorLines = 8;
constexpr std::size_t kErrorLineLength = 400;
constexpr std::chrono::milliseconds kTermGrace{500};
/// One wait: a signal may reach another thread, so the stop flag is looked at this often.
constexpr std::chrono::milliseconds kLongestWait{std::chrono::hours(1)}, kStopSlice{100};

struct Pipe {
  Descriptor read, write;
};

/// Keeps clear of 0, 1 and 2, which a caller may have closed: the child's ends are copied there.
Descriptor AboveStandard(Descriptor end) {
  if (end.get() > 2) return end;
  const int moved = fcntl(end.get(), F_DUPFD_CLOEXEC, 3);
  if (moved < 0) throw std::system_error(errno, std::generic_category(), "fcntl");
  return Descriptor(moved);
}

Pipe MakePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  Descriptor read(ends[0]), write(ends[1]);
  return {AboveStandard(std::move(read)), AboveStandard(std::move(write))};
}

void SetNonBlocking(const Descriptor& end) {
  fcntl(end.get(), F_SETFL, fcntl(end.get(), F_GETFL) | O_NONBLOCK);
}

/// While it lives, writing to a broken pipe is an error value in this thread, not a signal.
class SigpipeGuard {
 public:
  SigpipeGuard() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
  }
  ~SigpipeGuard() {
    const timespec now{};
    if (!was_pending_) sigtimedwait(&sigpipe_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SigpipeGuard(const SigpipeGuard&) = delete;
  SigpipeGuard& operator=(const SigpipeGuard&) = delete;

 private:
  sigset_t sigpipe_{}, before_{};
  bool was_pending_ = false;
};

/// The file actions and attributes of posix_spawn, released on every path.
struct SpawnPlan {
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  SpawnPlan() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

/// The child gets default signals, an empty mask, a group of its own and no descriptor but three.
int Spawn(const std::vector<std::string>& command, const std::filesystem::path& folder,
          const std::array<int, 3>& standard, pid_t& pid) {
  SpawnPlan plan;
  for (int to = 0; to < 3; ++to) {
    posix_spawn_file_actions_adddup2(&plan.actions, standard[static_cast<std::size_t>(to)], to);
  }
  posix_spawn_file_actions_addclosefrom_np(&plan.actions, 3);
  posix_spawn_file_actions_addchdir_np(&plan.actions, folder.c_str());

  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&plan.attributes, &none);
  posix_spawnattr_setsigdefault(&plan.attributes, &all);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(
      &plan.attributes,
      static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP));
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return posix_spawnp(&pid, arguments[0], &plan.actions, &plan.attributes, arguments.data(),
                      environ);
}

/// Reads what is there, up to a bound (a child that never stops talking must not hold us); closes
/// `from` at its end.
template <typename Sink>
void Drain(Descriptor& from, const Sink& sink) {
  std::array<char, 16384> buffer;
  for (int reads = 0; reads < 16 && from.open(); ++reads) {
    const ssize_t count = read(from.get(), buffer.data(), buffer.size());
    if (count > 0) {
      sink(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
      if (static_cast<std::size_t>(count) < buffer.size()) return;
    } else if (count < 0 && errno == EAGAIN) {
      return;
    } else if (count == 0 || errno != EINTR) {
      from.Close();
    }
  }
}

std::optional<std::string> TakeLine(std::string& received) {
  const std::size_t end = received.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received.substr(0, end);
  received.erase(0, end + 1);
  return line;
}

std::string DescribeEnding(int status) {
  if (WIFEXITED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const char* name = sigdescr_np(signal);
  return "signal " + std::to_string(signal) + " (" + (name ? name : "unknown") + ")";
}

}  // namespace

void Descriptor::Close() noexcept {
  if (fd_ >= 0) close(std::exchange(fd_, -1));
}

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::filesystem::path& working_folder) {
  if (command.empty() || command.front().empty()) {
    throw ProcessStartError("the command is empty; expected a program and its arguments");
  }
  std::error_code ignored;
  if (!std::filesystem::is_directory(working_folder, ignored)) {
    throw ProcessStartError("its working folder '" + working_folder.string() + "' is not a folder");
  }
  Pipe in = MakePipe(), out = MakePipe(), err = MakePipe();
  const int failure =
      Spawn(command, working_folder, {in.read.get(), out.write.get(), err.write.get()}, pid_);
  if (failure != 0) {
    pid_ = -1;
    throw ProcessStartError("can't start '" + command.front() + "' in '" + working_folder.string() +
                            "': " + std::generic_category().message(failure));
  }
  input_ = std::move(in.write);
  output_ = std::move(out.read);
  errors_ = std::move(err.read);
  for (const Descriptor* end : {&input_, &output_, &errors_}) SetNonBlocking(*end);
}

ChildProcess::Answer ChildProcess::Exchange(std::string_view text, std::chrono::nanoseconds timeout,
                                            const std::atomic<bool>* stop) {
  const Clock::time_point deadline = Clock::now() + timeout;
  ReadOutput();
  if (!received_.empty()) return {Outcome::kUnasked, std::exchange(received_, {})};
  while (true) {
    Send(text);
    if (auto line = TakeLine(received_)) {
      // An answer to a question that it has not read yet is none.
      return {text.empty() || !input_.open() ? Outcome::kLine : Outcome::kUnasked, *line};
    }
    if (!output_.open()) return {Outcome::kClosed, std::exchange(received_, {})};
    if (received_.size() > kLongestLine) return {Outcome::kTooLong, received_.substr(0, 200)};
    if (stop != nullptr && *stop) return {Outcome::kStopped, received_};
    const auto longest = stop != nullptr ? kStopSlice : kLongestWait;
    if (!Wait(deadline, longest, !text.empty())) return {Outcome::kTimeout, received_};
  }
}

void ChildProcess::Send(std::string_view& unsent) {
  if (unsent.empty() || !input_.open()) return;
  const SigpipeGuard guard;
  while (!unsent.empty()) {
    const ssize_t count = write(input_.get(), unsent.data(), unsent.size());
    if (count >= 0) {
      unsent.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      return;
    } else if (errno != EINTR) {
      input_.Close();  // it no longer listens; what it still says, and its end, tell why
      return;
    }
  }
}

/// Waits until something can be read (and reads it) or written, at most `longest`. False once the
/// deadline has passed.
bool ChildProcess::Wait(Clock::time_point deadline, std::chrono::milliseconds longest,
                        bool writable) {
  const auto left = deadline - Clock::now();
  if (left <= Clock::duration::zero()) return false;
  const auto wait = std::min(std::chrono::ceil<std::chrono::milliseconds>(left), longest);
  std::array<pollfd, 3> ends{{{output_.get(), POLLIN, 0},
                              {errors_.get(), POLLIN, 0},
                              {writable ? input_.get() : -1, POLLOUT, 0}}};
  const int wait_ms = static_cast<int>(wait.count());
  if (poll(ends.data(), ends.size(), wait_ms) <= 0) return true;  // the deadline is looked at again
  if (ends[0].revents != 0) ReadOutput();
  if (ends[1].revents != 0) ReadErrors();
  return true;
}

void ChildProcess::ReadOutput() {
  Drain(output_, [this](std::string_view text) { received_ += text; });
}

void ChildProcess::ReadErrors() {
  Drain(errors_, [this](std::string_view text) {
    for (const char c : text) {
      if (c == '\n' || error_lines_.empty()) error_lines_.emplace_back();
      if (c != '\n' && error_lines_.back().size() < kErrorLineLength) error_lines_.back() += c;
    }
    while (error_lines_.size() > kErrorLines + 1) error_lines_.pop_front();
  });
}

std::string ChildProcess::LastErrors() const {
  std::string text;
  for (const std::string& line : error_lines_) {
    if (!line.empty()) text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

bool ChildProcess::HasEnded() const noexcept {
  siginfo_t info{};
  const int result = waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
  return (result == 0 && info.si_pid == pid_) || (result != 0 && errno == ECHILD);
}

/// Reads on while it waits: a child that is stuck in a full pipe could not leave.
bool ChildProcess::WaitForEnd(std::chrono::milliseconds grace) noexcept {
  const Clock::time_point deadline = Clock::now() + grace;
  while (!HasEnded()) {
    if (Clock::now() >= deadline) return false;
    std::array<pollfd, 2> ends{{{output_.get(), POLLIN, 0}, {errors_.get(), POLLIN, 0}}};
    poll(ends.data(), ends.size(), 1);
    Drain(output_, [](std::string_view) {});
    ReadErrors();
  }
  return true;
}

void ChildProcess::End(std::chrono::milliseconds grace) noexcept {
  if (pid_ < 0) return;
  input_.Close();
  if (!WaitForEnd(grace)) {
    kill(-pid_, SIGTERM);
    WaitForEnd(kTermGrace);
  }
  // Before the leader is reaped, so that the group's number can't have found a new owner: whatever
  // still runs, the leader or what it started, ends here.
  kill(-pid_, SIGKILL);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  ReadErrors();
  output_.Close();
  errors_.Close();
  ending_ = DescribeEnding(status);
  pid_ = -1;
}

}  // namespace reckon::harness
