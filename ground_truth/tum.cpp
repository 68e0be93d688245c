#include "reckon/ground_truth/tum.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "reckon/ground_truth/run_recorder.h"

namespace reckon::ground_truth {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

[[noreturn]] void ThrowErrno(const std::filesystem::path& path, const char* action) {
  throw RecordingError(fmt::format("{}: {}: {}", path.string(), action, std::strerror(errno)));
}

/// Eight numbers separated by blanks; whether `line` is just that.
bool Parse(std::string_view line, std::array<double, 8>& numbers) {
  const char *at = line.data(), *const end = at + line.size();
  const auto skip = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
  };
  for (double& number : numbers) {
    skip();
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc()) return false;
    at = next;
  }
  skip();
  return at == end;
}

}  // namespace

TumWriter::TumWriter(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "wb"), &std::fclose) {
  if (!file_) ThrowErrno(path_, "can't write");
}
TumWriter::~TumWriter() = default;
TumWriter::TumWriter(TumWriter&&) noexcept = default;
TumWriter& TumWriter::operator=(TumWriter&&) noexcept = default;

void TumWriter::Add(models::TimeNs t_ns, const models::Pose& X_WB) {
  Eigen::Quaterniond q(X_WB.R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const models::TimeNs magnitude = t_ns < 0 ? -t_ns : t_ns;
  fmt::format_to(fmt::appender(text_), FMT_COMPILE("{}{}.{:09} {} {} {} {} {} {} {}\n"),
                 t_ns < 0 ? "-" : "", magnitude / models::kNsPerSecond,
                 magnitude % models::kNsPerSecond, X_WB.p.x(), X_WB.p.y(), X_WB.p.z(), q.x(), q.y(),
                 q.z(), q.w());
  if (text_.size() >= kBufferBytes) Flush();
}

void TumWriter::Flush() {
  if (std::fwrite(text_.data(), 1, text_.size(), file_.get()) != text_.size()) {
    ThrowErrno(path_, "can't write");
  }
  text_.clear();
}

void TumWriter::Close() {
  if (!file_) return;
  Flush();
  if (std::fclose(file_.release()) != 0) ThrowErrno(path_, "can't close");
}

std::vector<StampedPose> ReadTum(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) ThrowErrno(path, "can't read");
  std::vector<StampedPose> poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::array<double, 8> n{};
    if (!Parse(line, n)) {
      throw RecordingError(fmt::format("{}:{}: not eight numbers", path.string(), number));
    }
    const Eigen::Quaterniond q = Eigen::Quaterniond(n[7], n[4], n[5], n[6]).normalized();
    poses.push_back({std::llround(n[0] * 1e9), {q.toRotationMatrix(), {n[1], n[2], n[3]}}});
  }
  return poses;
}

}  // namespace reckon::ground_truth
