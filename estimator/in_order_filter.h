#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/filter_beliefs.h"
#include "reckon/estimator/gyro_filter.h"
#include "reckon/estimator/held_sample.h"
#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/mistrust.h"
#include "reckon/estimator/report.h"
#include "reckon/estimator/rest_average.h"
#include "reckon/estimator/standing_feet.h"
#include "reckon/estimator/velocity_model.h"

namespace reckon::estimator {

/// A filter that an IMU moves and other sensors correct, for measurements in the order of their
/// validity: `Hold` an IMU sample, then `AdvanceTo` each correction within its reach and `Correct`,
/// then to the sample's end and `EndSample`. It is a value: copied, it is the filter of an earlier
/// time. `Core` is the error form; all else is shared, so that two filters of this kind differ in
/// their error alone. Nothing here allocates.
///
/// Missing IMU samples are bridged (HeldSample). Feet are linearised once and taken in one after
/// the other, also where other corrections are iterated.
///
/// Reports may be null: nobody hears of the corrections then.
template <class Core>
class InOrderFilter {
 public:
  /// `beliefs` must outlive it and its copies.
  explicit InOrderFilter(const FilterBeliefs& beliefs);

  /// Starts at a state of I and its right-invariant covariance. Biases that are not estimated keep
  /// their values.
  void Start(models::TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P);

  /// Takes the sample that moves the filter up to `valid_ns`. The time without samples that this
  /// bridges [ns].
  models::TimeNs Hold(models::TimeNs valid_ns, const models::ImuSample& sample);

  /// A second source of the angular rate, for the gyro filter, if there is one.
  void Refine(const models::Measurement& measurement, Report* report);

  void AdvanceTo(models::TimeNs t_ns);

  /// Moves beyond the newest sample, as if what follows were a gap.
  void CoastTo(models::TimeNs t_ns);

  void Correct(const models::Measurement& measurement, Report* report);

  /// What follows from the sample that is now behind: zero velocity and rate at standstill.
  void EndSample(Report* report);

  /// After a gap too long to bridge: starts again where it was, see `Reanchor`.
  void StartAgain(models::TimeNs t_ns, const Eigen::Vector3d& up_I);

  /// A believed turn rate of I, bias and all, until the first sample is there.
  void set_rate(const Eigen::Vector3d& w) { held_.set_gyro(w); }

  /// The belief of the body, at `t_ns()`.
  Estimate Belief() const;
  models::TimeNs t_ns() const { return t_ns_; }
  const Core& core() const { return core_; }

 private:
  void Use(const models::Measurement& m, const models::BodyVelocitySample& y, Report* report);
  void Use(const models::Measurement& m, const models::EncoderSample& y, Report* report);
  void Use(const models::Measurement& m, const models::DepthSample& y, Report* report);
  void Use(const models::Measurement& m, const models::PoseSample& y, Report* report);
  void Use(const models::Measurement& m, const models::ContactSample& y, Report* report);
  void Use(const models::Measurement& m, const models::TorqueSample& y, Report* report);
  void Use(const models::Measurement& m, const models::FootForceSample& y, Report* report);
  void Use(const models::Measurement& /*m*/, const models::ImuSample& /*y*/, Report* /*report*/) {}
  void UseLegs(const models::Measurement& m, const models::EncoderSample& y, Report* report);
  void CorrectFeet(const models::Measurement& m, const StandingFeet::Readings& readings,
                   Report* report);
  void UseAsVelocity(const models::Measurement& m, const StandingFeet::Readings& readings,
                     Report* report);
  void WatchSlip(const StandingFeet::Readings& readings);
  void Excuse(const models::Measurement& m, Slot foot, const Linearisation<3>& own, Report* report);
  void LiftFeet();
  void AddFootNoise(double dt);
  void RefineByImu(const models::Measurement& m, const models::ImuSample& y, Report* report);
  void StartMeanBias();
  template <class Point>
  void UseFloor(const models::Measurement& m, Slot slot, const Point& point, Report* report);

  /// Judges and reports a correction of this form's coordinates, which sees the slots `seen` of a
  /// right-invariant error, and if it is to be used, use(kalman, decision) does so; nothing if it
  /// is not.
  template <int kRows, class Taken>
  std::optional<Correction> IfItFits(models::TimeNs t_ns, models::SensorId sensor,
                                     const Linearisation<kRows>& own, SlotSet seen,
                                     const Taken& use, Report* report);

  /// Corrects with what `model` says at a state, a Linearisation<1 or 3>; nothing if it was not
  /// used.
  template <class Model>
  std::optional<Correction> Apply(models::TimeNs t_ns, models::SensorId sensor, const Model& model,
                                  Report* report);

  /// Puts the blame for a correction that does not fit on its sensor or on the belief.
  void Blame(Correction& correction);

  ProcessNoise NoiseAt(models::TimeNs t_ns) const;
  TurnRate Turn() const;
  Eigen::Vector3d BiasOfFirst() const { return core_.x().gyro_bias + stage_.bias_of_first(); }
  Eigen::Vector3d Rate() const { return beliefs_->gyro_source ? stage_.rate() : held_.gyro(); }

  const FilterBeliefs* beliefs_;
  Core core_;
  models::TimeNs t_ns_ = 0;

  HeldSample held_;
  Widening widening_;
  GyroFilterStage stage_;  ///< idle without a second source of the rate
  RestAverage rest_;
  StandingFeet feet_;
  std::array<bool, kMaxFeet> slips_{};
  RollingFeet::Columns slip_;  ///< the velocity that a foot slips with, in this form's axes
  Mistrust mistrust_;
};

}  // namespace reckon::estimator
