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
};

}  // namespace reckon::estimator
