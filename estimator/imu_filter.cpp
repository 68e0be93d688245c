#include "reckon/estimator/imu_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reckon/estimator/pose_prior.h"
#include "reckon/estimator/sample_checks.h"
#include "reckon/estimator/setup_checks.h"

namespace reckon::estimator {
namespace {

using models::Measurement;
using models::TimeNs;

/// The least history, so that what travels no longer than IMU samples is never late.
constexpr TimeNs kLeastWindow = 15'000'000;
/// Copies of the filter that span the history.
constexpr std::size_t kMoments = 32;
/// A correction that is further ahead of the IMU is not worth waiting for.
constexpr TimeNs kLongestWait = models::kNsPerSecond;
/// Steady samples beyond a long gap before the filter believes in the new time.
constexpr double kNewTime = 1.0;  ///< s

TimeNs Window(const FilterBeliefs& beliefs) {
  const auto told_ns = static_cast<TimeNs>(std::llround(1e9 * beliefs.setup.history_s));
  return std::max({told_ns, kLeastWindow, 3 * beliefs.period_ns / 2});
}

/// Entries that the sensors can send while something is remembered or waits, with as much again for
/// those that send faster than they say.
std::size_t Capacity(const FilterBeliefs& beliefs, TimeNs window_ns) {
  constexpr TimeNs kUnknownPeriod = 10'000'000;
  std::size_t entries = 64;
  for (const models::MountedSensor& sensor : beliefs.setup.suite.sensors) {
    const TimeNs period_ns = sensor.period_ns > 0 ? sensor.period_ns : kUnknownPeriod;
    entries += static_cast<std::size_t>(2 * (window_ns + kLongestWait) / period_ns);
  }
  return entries;
}

}  // namespace

template <class Core>
ImuFilter<Core>::ImuFilter(const Setup& setup)
    : beliefs_(setup),
      window_ns_(Window(beliefs_)),
      static_(setup, models::Seconds(beliefs_.period_ns)),
      now_(beliefs_),
      line_(Capacity(beliefs_, window_ns_)),
      moments_(kMoments, {now_, 0}),
      beyond_(setup.noise, models::Seconds(beliefs_.period_ns), setup.gravity_m_s2) {}

template <class Core>
void ImuFilter<Core>::Start(const Prior& prior) {
  CheckPrior(prior);
  prior_ = prior;
  line_.Clear();
  moments_.Clear();
  beyond_.Restart();
  started_ = false;
  newest_imu_ns_ = prior.t_ns;
  last_heard_ns_ = std::numeric_limits<TimeNs>::max();
  static_.Start(prior);
  if (beliefs_.setup.initialisation.kind != InitialisationKind::kPrior) return;
  NavigationState x;
  x.R = prior.X_WB.R;
  x.p = prior.X_WB * beliefs_.p_BI;
  x.v = prior.v_WB + prior.X_WB.R * prior.w_WB_B.cross(beliefs_.p_BI);
  x.gyro_bias = prior.gyro_bias_rad_s;
  x.accel_bias = prior.accel_bias_m_s2;
  Begin(prior.t_ns, x, prior.covariance);
  now_.set_rate(prior.w_WB_B + prior.gyro_bias_rad_s);
}

/// Error coordinates of the body and of I agree in right-invariant form but for the turn over the
/// lever arm, which the prior takes as known.
template <class Core>
void ImuFilter<Core>::Begin(TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P) {
  now_.Start(t_ns, x, P);
  started_ = true;
  next_ = line_.PlaceFor(t_ns);
  line_.DropBefore(next_);
  moments_.Clear();
  moments_.PushBack({now_, next_});
}

template <class Core>
Report ImuFilter<Core>::Process(const Measurement& measurement) {
  Report report;
  report.refusal = WhatIsWrong(measurement, beliefs_.setup.suite);
  if (report.refusal != Refusal::kNone) return report;
  if (started_) {
    Take(measurement, report);
  } else {
    Initialise(measurement, report);
  }
  return report;
}

template <class Core>
void ImuFilter<Core>::Initialise(const Measurement& measurement, Report& report) {
  report.refusal = IsImu(measurement) ? Refusal::kNone : beliefs_.WhyUseless(measurement);
  if (report.refusal != Refusal::kNone) return;
  if (IsImu(measurement)) return InitialiseFromImu(measurement, report);
  const auto* pose = std::get_if<models::PoseSample>(&measurement.sample);
  const auto kind = beliefs_.setup.initialisation.kind;
  if (kind == InitialisationKind::kPose && pose != nullptr && pose->has_orientation) {
    const FirstState first = StateFromPose(*pose, beliefs_.X_IS[measurement.sensor],
                                           beliefs_.setup.noise.pose_scale, prior_);
    Begin(measurement.valid_ns, first.x, first.P);
    return Run(report);
  }
  report.refusal = Refusal::kNotInitialised;
  const auto* encoders = std::get_if<models::EncoderSample>(&measurement.sample);
  if (encoders != nullptr && !static_.AddWheelRate(encoders->rate_rad_s.cwiseAbs().maxCoeff())) {
    report.refusal = Refusal::kMoving;
  }
}

template <class Core>
void ImuFilter<Core>::InitialiseFromImu(const Measurement& measurement, Report& report) {
  const TimeNs t_ns = measurement.valid_ns;
  const TimeNs since_ns = t_ns - newest_imu_ns_;
  report.refusal = since_ns <= 0             ? Refusal::kBackwards
                   : since_ns <= kLongestGap ? Refusal::kNotInitialised
                                             : Refusal::kGap;
  // A prior of another time is no gap; a second sample confirms the new one.
  const TimeNs last_ns = std::exchange(last_heard_ns_, t_ns);
  const bool goes_on = t_ns > last_ns && t_ns - last_ns <= kLongestGap;
  if (report.refusal == Refusal::kGap && goes_on) report.refusal = Refusal::kNotInitialised;
  if (report.refusal != Refusal::kNotInitialised) return;
  newest_imu_ns_ = t_ns;
  if (beliefs_.setup.initialisation.kind == InitialisationKind::kPose) {
    line_.Insert(measurement);  // a pose of an earlier time needs what came since
    return;
  }
  const auto& sample = std::get<models::ImuSample>(measurement.sample);
  const auto progress =
      static_.Add(beliefs_.R_BS_imu * sample.gyro_rad_s, beliefs_.R_BS_imu * sample.accel_m_s2,
                  models::Seconds(sample.interval_ns));
  if (progress == StaticInitialiser::Progress::kMoving) report.refusal = Refusal::kMoving;
  if (progress != StaticInitialiser::Progress::kDone) return;
  report.refusal = Refusal::kNone;
  Begin(t_ns, static_.State(beliefs_.p_BI), static_.Covariance());
}

template <class Core>
void ImuFilter<Core>::Take(const Measurement& measurement, Report& report) {
  const bool imu = IsImu(measurement);
  report.refusal = imu ? WhyImuRefused(measurement) : WhyRefused(measurement);
  if (report.refusal == Refusal::kGap) Reanchor(measurement, report);
  if (report.refusal != Refusal::kNone || report.reanchored) return;
  const TimeNs before_ns = now_.t_ns();
  // The gyro filter's source changes the sample that ends with it.
  const TimeNs from_ns =
      measurement.valid_ns - (measurement.sensor == beliefs_.gyro_source ? 1 : 0);
  const bool behind = from_ns < before_ns;
  if (behind && !RollBack(from_ns)) {
    report.refusal = Refusal::kLate;
    return;
  }
  line_.Insert(measurement);
  Run(report);
  report.propagated = now_.t_ns() > before_ns;
}

template <class Core>
Refusal ImuFilter<Core>::WhyRefused(const Measurement& m) const {
  if (const Refusal useless = beliefs_.WhyUseless(m); useless != Refusal::kNone) return useless;
  const TimeNs ahead_ns = m.valid_ns - now_.t_ns();
  if (ahead_ns > kLongestWait) return Refusal::kFromFuture;
  if (line_.Has(m.sensor, m.valid_ns)) return Refusal::kDuplicate;
  if (ahead_ns > 0) return HasRoomToWait(m) ? Refusal::kNone : Refusal::kFromFuture;
  return -ahead_ns > window_ns_ ? Refusal::kLate : Refusal::kNone;
}

template <class Core>
Refusal ImuFilter<Core>::WhyImuRefused(const Measurement& m) const {
  const TimeNs ahead_ns = m.valid_ns - now_.t_ns();
  if (ahead_ns > kLongestGap) return Refusal::kGap;
  if (ahead_ns > 0) return Refusal::kNone;
  if (line_.Has(m.sensor, m.valid_ns)) return Refusal::kDuplicate;
  if (-ahead_ns > window_ns_ || !FillsGap(m)) return Refusal::kBackwards;
  return Refusal::kNone;
}

/// Whether an IMU sample from behind lies where one was missing.
template <class Core>
bool ImuFilter<Core>::FillsGap(const Measurement& m) const {
  const Place place = line_.PlaceFor(m.valid_ns);
  const Place later = line_.Next(m.sensor, place), earlier = line_.Previous(m.sensor, place);
  if (later == line_.end()) return false;
  const TimeNs interval_ns =
      std::get<models::ImuSample>(line_[later].measurement.sample).interval_ns;
  const TimeNs known_ns =
      earlier == line_.end() ? moments_.front().filter.t_ns() : line_[earlier].t_ns();
  return line_[later].t_ns() - interval_ns - known_ns > interval_ns / 2;
}

/// Whether all corrections that wait fit into one report, beside those of a standstill.
template <class Core>
bool ImuFilter<Core>::HasRoomToWait(const Measurement& m) const {
  int corrections = 2 + beliefs_.MostCorrections(m);
  for (Place place = next_; place < line_.end(); ++place) {
    corrections += beliefs_.MostCorrections(line_[place].measurement);
  }
  return corrections <= kMaxCorrections;
}

/// A sample from beyond a gap too long to bridge. Once they have come steadily for a while, the
/// filter starts again there.
template <class Core>
void ImuFilter<Core>::Reanchor(const Measurement& m, Report& report) {
  const auto& sample = std::get<models::ImuSample>(m.sample);
  const TimeNs since_ns = m.valid_ns - newest_imu_ns_;
  newest_imu_ns_ = m.valid_ns;
  const bool steady = since_ns > sample.interval_ns / 2 && since_ns < 4 * sample.interval_ns;
  if (!steady) beyond_.Restart();
  beyond_.Add(beliefs_.R_BS_imu * sample.gyro_rad_s, beliefs_.R_BS_imu * sample.accel_m_s2,
              models::Seconds(sample.interval_ns));
  if (beyond_.seconds() < kNewTime) return;
  report.refusal = Refusal::kNone;
  report.propagated = report.reanchored = true;
  report.bridged_ns = m.valid_ns - now_.t_ns();
  now_.StartAgain(m.valid_ns, beyond_.accel());
  beyond_.Restart();
  line_.Clear();
  next_ = line_.end();
  moments_.Clear();
  moments_.PushBack({now_, next_});
}

template <class Core>
bool ImuFilter<Core>::RollBack(TimeNs to_ns) {
  while (!moments_.empty() && moments_.front().next < line_.begin()) moments_.PopFront();
  if (moments_.empty() || moments_.front().filter.t_ns() > to_ns) return false;
  while (moments_.back().filter.t_ns() > to_ns) moments_.PopBack();
  now_ = moments_.back().filter;
  next_ = moments_.back().next;
  return true;
}

template <class Core>
template <class Tell>
void ImuFilter<Core>::Step(InOrderFilter<Core>& filter, Place& next, Place imu, TimeNs until_ns,
                           const Tell& tell) const {
  const TimedEntry& sample = line_[imu];
  const TimeNs bridged_ns =
      filter.Hold(sample.t_ns(), std::get<models::ImuSample>(sample.measurement.sample));
  if (beliefs_.gyro_source) {
    for (Place place = next; place < line_.end() && line_[place].t_ns() <= sample.t_ns(); ++place) {
      if (line_[place].Is(*beliefs_.gyro_source)) {
        filter.Refine(line_[place].measurement, tell(place, true));
      }
    }
  }
  for (; next <= imu && line_[next].t_ns() <= until_ns; ++next) {
    filter.AdvanceTo(line_[next].t_ns());
    if (next != imu) filter.Correct(line_[next].measurement, tell(next, false));
  }
  filter.AdvanceTo(std::min(sample.t_ns(), until_ns));
  if (next <= imu) return;
  Report* report = tell(imu, false);
  if (report != nullptr) report->bridged_ns += bridged_ns;
  filter.EndSample(report);
}

template <class Core>
void ImuFilter<Core>::Run(Report& report) {
  const auto tell = [&](Place place, bool rate) {
    bool& heard = rate ? line_[place].rate_heard : line_[place].heard;
    Report* told = heard ? nullptr : &report;
    heard = true;
    return told;
  };
  for (;;) {
    // What has the stamp of the newest sample and came after it.
    for (; next_ < line_.end() && line_[next_].t_ns() <= now_.t_ns(); ++next_) {
      now_.Correct(line_[next_].measurement, tell(next_, false));
    }
    const Place imu = line_.Next(beliefs_.imu, next_);
    if (imu == line_.end()) return;
    Step(now_, next_, imu, line_[imu].t_ns(), tell);
    KeepMoment();
  }
}

template <class Core>
void ImuFilter<Core>::KeepMoment() {
  constexpr TimeNs kSpan = kMoments - 2;
  if (!moments_.empty() && now_.t_ns() - moments_.back().filter.t_ns() < window_ns_ / kSpan) return;
  const TimeNs oldest_ns = now_.t_ns() - window_ns_;
  while (moments_.size() > 1 && moments_[moments_.begin() + 1].filter.t_ns() <= oldest_ns) {
    moments_.PopFront();
  }
  if (moments_.full()) moments_.PopFront();
  moments_.PushBack({now_, next_});
  line_.DropBefore(moments_.front().next);
}

template <class Core>
std::optional<Estimate> ImuFilter<Core>::Belief() const {
  if (!started_) return std::nullopt;
  return now_.Belief();
}

template <class Core>
std::optional<Estimate> ImuFilter<Core>::BeliefAt(TimeNs t_ns) const {
  if (!started_ || t_ns - now_.t_ns() > kLongestGap) return std::nullopt;
  if (t_ns >= now_.t_ns()) {
    InOrderFilter<Core> later = now_;
    if (t_ns > now_.t_ns()) later.CoastTo(t_ns);
    return later.Belief();
  }
  Place moment = moments_.end();
  while (moment > moments_.begin() && moments_[moment - 1].filter.t_ns() > t_ns) --moment;
  if (moment == moments_.begin() || moments_[moment - 1].next < line_.begin()) return std::nullopt;
  auto [then, next] = moments_[moment - 1];
  const auto nobody = [](Place /*place*/, bool /*rate*/) -> Report* { return nullptr; };
  for (;;) {
    for (; next < line_.end() && line_[next].t_ns() <= then.t_ns(); ++next) {
      then.Correct(line_[next].measurement, nullptr);
    }
    const Place imu = line_.Next(beliefs_.imu, next);
    if (then.t_ns() >= t_ns || imu == line_.end()) return then.Belief();
    Step(then, next, imu, t_ns, nobody);
  }
}

template class ImuFilter<RightInvariantEkf>;
template class ImuFilter<LeftInvariantEkf>;
template class ImuFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
