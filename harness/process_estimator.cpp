#include "reckon/harness/process_estimator.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "reckon/harness/process_answer.h"
#include "reckon/harness/process_messages.h"

namespace reckon::harness {
namespace {

constexpr std::chrono::milliseconds kLeaveGrace{200};

std::unique_ptr<ChildProcess> StartChild(const ProcessOptions& options) {
  if (!(options.timeout_s > 0.0 && options.timeout_s <= 86400.0)) {
    throw ProcessStartError(
        fmt::format("estimator '{}': timeout_s must lie in (0, 86400], found {}", options.name,
                    options.timeout_s));
  }
  try {
    return std::make_unique<ChildProcess>(options.command, options.working_folder);
  } catch (const ProcessStartError& error) {
    throw ProcessStartError(fmt::format("estimator '{}': {}", options.name, error.what()));
  }
}

std::string Shortened(std::string text, std::size_t length) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > length ? text.substr(0, length) + "…" : text;
}

std::string Describe(const ChildProcess::Answer& answer, const ChildProcess& child,
                     double timeout_s) {
  std::string text = Shortened(answer.text, 160);
  const std::string part = text.empty() ? "" : fmt::format(" after the partial line '{}'", text);
  switch (answer.outcome) {
    case ChildProcess::Outcome::kTimeout:
      return fmt::format(
          "no whole line came within {} s{} (is the output flushed after every line?)", timeout_s,
          part);
    case ChildProcess::Outcome::kClosed:
      return fmt::format("the program ended with {}{}", child.ending(), part);
    case ChildProcess::Outcome::kUnasked:
      return fmt::format(
          "it spoke unasked: '{}' (one line for each message; "
          "anything else belongs on standard error)",
          text);
    case ChildProcess::Outcome::kTooLong:
      return fmt::format("a line longer than {} bytes came: '{}'", ChildProcess::kLongestLine,
                         text);
    case ChildProcess::Outcome::kLine:
    case ChildProcess::Outcome::kStopped:
      break;
  }
  return text;
}

}  // namespace

ProcessEstimator::ProcessEstimator(ProcessOptions options, const estimator::Setup& setup)
    : options_(std::move(options)),
      sensors_(setup.suite.sensors.size()),
      unsent_hello_(HelloMessage(options_.robot, setup)),
      child_(StartChild(options_)) {}

/// Somebody who stops a run doesn't want to wait for the patience that a program may otherwise
/// need to write down what it learnt.
ProcessEstimator::~ProcessEstimator() {
  if (options_.stop != nullptr && *options_.stop) child_->End(kLeaveGrace);
}

void ProcessEstimator::Start(const estimator::Prior& prior) {
  constexpr std::string_view kQuestion = "'start'";
  const std::string line = Ask(std::exchange(unsent_hello_, {}) + StartMessage(prior), kQuestion);
  try {
    form_ = ParseReady(line);
  } catch (const BadAnswer& error) {
    Fail(kQuestion, error.what());
  }
  belief_.reset();
  earliest_ns_ = latest_ns_ = prior.t_ns;
  answered_ = 0;
}

estimator::Report ProcessEstimator::Process(const models::Measurement& measurement) {
  const std::string question = fmt::format("measurement {} (sensor {}, valid at {} ns)", answered_,
                                           measurement.sensor, measurement.valid_ns);
  const std::string line = Ask(MeasurementMessage(measurement), question);
  latest_ns_ = std::max({latest_ns_, measurement.valid_ns, measurement.arrival_ns});
  ++answered_;
  try {
    ProcessAnswer answer = ParseAnswer(line, {form_, sensors_, measurement.sensor,
                                              measurement.valid_ns, earliest_ns_, latest_ns_});
    if (answer.belief) {
      answer.report.propagated = answer.belief->t_ns > earliest_ns_;
      earliest_ns_ = answer.belief->t_ns;
      belief_ = std::move(answer.belief);
    }
    return answer.report;
  } catch (const BadAnswer& error) {
    Fail(question, error.what());
  }
}

std::string ProcessEstimator::Ask(std::string_view text, std::string_view question) {
  if (!failure_.empty()) throw ProcessFailure(failure_);
  const auto timeout = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(options_.timeout_s));
  ChildProcess::Answer answer = child_->Exchange(text, timeout, options_.stop);
  if (answer.outcome == ChildProcess::Outcome::kLine) return std::move(answer.text);
  if (answer.outcome == ChildProcess::Outcome::kStopped) {
    failure_ = fmt::format("estimator '{}' was interrupted, answering {}", options_.name, question);
    child_->End(kLeaveGrace);
    throw ProcessInterrupted(failure_);
  }
  if (answer.outcome == ChildProcess::Outcome::kClosed) child_->End(kLeaveGrace);
  Fail(question, "expected one line of JSON, but " + Describe(answer, *child_, options_.timeout_s));
}

void ProcessEstimator::Fail(std::string_view question, std::string_view what) {
  child_->End(kLeaveGrace);
  const std::string errors = child_->LastErrors();
  failure_ = fmt::format("estimator '{}' ({}), answering {}: {}", options_.name,
                         Shortened(fmt::format("{}", fmt::join(options_.command, " ")), 160),
                         question, what);
  failure_ += errors.empty() ? "; it wrote nothing to standard error"
                             : "; its last lines of standard error:\n" + errors;
  throw ProcessFailure(failure_);
}

}  // namespace reckon::harness
