#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "reckon/estimator/estimator.h"
#include "reckon/estimator/filter_beliefs.h"
#include "reckon/estimator/in_order_filter.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/static_initialiser.h"
#include "reckon/estimator/time_line.h"

namespace reckon::estimator {

/// The door to an InOrderFilter: it takes measurements as they arrive and gives each its own time.
///
/// A correction from ahead of the state waits until the IMU is there. One from behind (late, or out
/// of order), and an IMU sample that fills a gap, roll the filter back: it is restored from a copy
/// of its state and goes through everything since again. History is bounded by `Setup::history_s`
/// (not less than 1.5 IMU periods and 15 ms); what is older is refused as late. Cost: a roll-back
/// over T seconds takes T times the IMU's rate propagations, plus history_s/60 of them on average
/// (31 copies span the history, 11 kB each), and one correction for each that lies in between; the
/// copies themselves cost 0.3 µs each. Corrections that are gone through again are judged by the
/// gate again and are not reported again.
template <class Core>
class ImuFilter final : public Estimator {
 public:
  /// Throws std::invalid_argument if the gate's probability is not one, and for what FilterBeliefs
  /// refuses.
  explicit ImuFilter(const Setup& setup);

  /// Throws std::invalid_argument for what CheckPrior refuses.
  void Start(const Prior& prior) override;
  Report Process(const models::Measurement& measurement) override;
  std::optional<Estimate> Belief() const override;
  std::optional<Estimate> BeliefAt(models::TimeNs t_ns) const override;

  const Core& core() const { return now_.core(); }

 private:
  using Place = TimeLine::Place;

  /// The filter at an earlier time: all entries before `next` are in it.
  struct Moment {
    InOrderFilter<Core> filter;
    Place next;
  };

  void Begin(models::TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P);
  void Initialise(const models::Measurement& measurement, Report& report);
  void InitialiseFromImu(const models::Measurement& measurement, Report& report);
  void InitialiseFromPose(const models::Measurement& measurement, Report& report);
  void Take(const models::Measurement& measurement, Report& report);
  Refusal WhyRefused(const models::Measurement& measurement) const;
  Refusal WhyImuRefused(const models::Measurement& measurement) const;
  bool HasRoomToWait(const models::Measurement& measurement) const;
  bool FillsGap(const models::Measurement& measurement) const;
  void Reanchor(const models::Measurement& measurement, Report& report);
  bool RollBack(models::TimeNs to_ns);
  void Run(Report& report);
  void KeepMoment();
  bool IsImu(const models::Measurement& m) const { return m.sensor == beliefs_.imu; }

  /// Moves `filter`, which holds all before `next`, over the IMU sample at `imu`, with the
  /// corrections on its way, to `until_ns` at most. `tell(place, rate)` is the report, or null,
  /// that an entry's corrections go to.
  template <class Tell>
  void Step(InOrderFilter<Core>& filter, Place& next, Place imu, models::TimeNs until_ns,
            const Tell& tell) const;

  FilterBeliefs beliefs_;
  models::TimeNs window_ns_;
  StaticInitialiser static_;
  Prior prior_;
  bool started_ = false;
  InOrderFilter<Core> now_;
  TimeLine line_;
  Place next_ = 0;                    ///< what is not in `now_` yet
  Ring<Moment> moments_;              ///< oldest first
  models::TimeNs newest_imu_ns_ = 0;  ///< while there is no state, or beyond a long gap
  models::TimeNs last_heard_ns_ = 0;  ///< of the IMU while there is no state, used or not
  RestAverage beyond_;                ///< of samples beyond a gap too long to bridge
};

extern template class ImuFilter<RightInvariantEkf>;
extern template class ImuFilter<LeftInvariantEkf>;
extern template class ImuFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
