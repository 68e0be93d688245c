#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/estimate.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/velocity_model.h"

namespace reckon::bench {

/// A right-invariant filter in the middle of a drive, with what its sensors say, and the operations
/// whose cost is counted. Each can be repeated without end: the state moves as a filter's would.
class EstimatorOperations {
 public:
  /// With this many feet in contact.
  explicit EstimatorOperations(int feet);

  /// One IMU sample: series, mean, exact covariance.
  void Predict();

  /// A velocity at the IMU's place in a sensor's axes: linearisation, NIS, gain, retraction and the
  /// structured Joseph update.
  void CorrectVelocity();

  /// The same of a sensor elsewhere: the gyroscope's bias is seen too.
  void CorrectVelocityOnLeverArm();

  /// A depth likewise: one row, which sees θ and p.
  void CorrectDepth();

  /// A standing foot each, one after the other, linearised at one state: each innovation is moved
  /// by what the feet before it have said, and the mean is retracted once.
  void CorrectFeet();

  /// The first foot comes and goes.
  void AddAndRemoveFoot();

  /// The covariance of the body's error, off the IMU.
  void BodyCovariance();

 private:
  estimator::TurnRate Turn() const;
  template <int kRows>
  void Correct(const estimator::Linearisation<kRows>& m);

  estimator::RightInvariantEkf core_;
  estimator::ErrorCovariance body_;
  std::array<estimator::FootReading, estimator::kMaxFeet> feet_;
  models::BodyVelocitySample velocity_;
  models::Pose X_IS_;
  double nis_ = 0.0;
};

/// An operation by its name in tables, and the feet of the state it works on.
struct Operation {
  std::string_view name;
  int feet;
  void (EstimatorOperations::*run)();
};

/// All of them, in the order of the tables.
const std::vector<Operation>& AllOperations();

}  // namespace reckon::bench
