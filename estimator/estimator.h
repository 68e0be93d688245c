#pragma once

#include <optional>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/report.h"
#include "reckon/estimator/setup.h"
#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// The one door: measurements go in, beliefs come out. Nothing else can be handed to an estimator.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Starts (again) from `prior`. With static initialisation only its yaw, position, biases and
  /// their covariance are used. May allocate.
  virtual void Start(const Prior& prior) = 0;

  /// Takes one measurement, in order of arrival. Does not allocate. A measurement that can't be
  /// used is refused with a reason in the report; the state stays finite whatever comes in.
  virtual Report Process(const models::Measurement& measurement) = 0;

  /// The belief at the stamp of the newest propagation; nothing before initialisation has finished.
  /// Does not allocate.
  virtual std::optional<Estimate> Belief() const = 0;

  /// The belief at any time: between two measurements of the past, or, ahead of the newest, with
  /// its motion held and less trust the longer that is. Nothing if it is not known any more, or if
  /// this estimator keeps no history and the time is not that of `Belief`. Does not allocate.
  virtual std::optional<Estimate> BeliefAt(models::TimeNs t_ns) const {
    const std::optional<Estimate> now = Belief();
    return now && now->t_ns == t_ns ? now : std::nullopt;
  }
};

}  // namespace reckon::estimator
