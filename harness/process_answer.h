#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/report.h"
#include "reckon/models/measurement.h"

namespace reckon::harness {

/// An answer that breaks the format: what was expected and what came.
class BadAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The error forms by their names in a message, each with its definition in plain text.
struct ErrorFormName {
  estimator::ErrorForm form;
  std::string_view name, meaning;
};
std::span<const ErrorFormName> ErrorFormNames();

/// The answer to `start`: the error form of the child's covariances. Throws BadAnswer.
estimator::ErrorForm ParseReady(std::string_view line);

/// What an answer is judged by.
struct AnswerContext {
  estimator::ErrorForm form = estimator::ErrorForm::kRightInvariant;
  std::size_t sensors = 0;         ///< how many `hello` named
  models::SensorId sensor = 0;     ///< of the measurement that is answered
  models::TimeNs valid_ns = 0;     ///< likewise
  models::TimeNs earliest_ns = 0;  ///< a belief may not be older: the previous belief, or the prior
  models::TimeNs latest_ns = 0;    ///< nor newer: the newest stamp that was sent
};

struct ProcessAnswer {
  std::optional<estimator::Estimate> belief;
  estimator::Report report;
};

/// The answer to a measurement. Refuses with BadAnswer: what is not one JSON object, unknown keys,
/// wrong types and sizes, a quaternion whose norm is not 1 within 1e-3 (else it is normalised), a
/// stamp outside the context, and a covariance that is not symmetric and positive semidefinite.
ProcessAnswer ParseAnswer(std::string_view line, const AnswerContext& context);

}  // namespace reckon::harness
