#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace reckon::harness {

/// A file or the command line is wrong. The message has one line an error, each of the form
/// `sc.yaml:7:3: error: unknown key 'gyro_nosie' in '/imu'; did you mean 'gyro_noise'?`
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a value was written: a place in a file (1-based), or an option of the command line.
struct Location {
  std::shared_ptr<const std::string> source;  ///< file, or `--set a.b=c`
  int line = 0, column = 0;                   ///< 0: the source as a whole

  std::string Text() const;
};

/// Collects what is wrong with an input, so that one look at the message mends several mistakes.
class Problems {
 public:
  /// Adds one error; what was said already is not said again.
  void Add(const Location& where, const std::string& what);
  bool empty() const { return lines_.empty(); }

  /// Throws InputError with everything that was added, if anything was.
  void ThrowIfAny() const;

 private:
  std::vector<std::string> lines_;
};

/// Throws InputError for one error at one place.
[[noreturn]] void Fail(const Location& where, const std::string& what);

}  // namespace reckon::harness
