#include "reckon/estimator/in_order_filter_inl.h"

// What an InOrderFilter makes of legs: which feet stand, and what their joints then say.
namespace reckon::estimator {

using Eigen::Vector3d;
using models::Measurement;

template <class Core>
void InOrderFilter<Core>::UseLegs(const Measurement& m, const models::EncoderSample& y,
                                  Report* report) {
  const Setup& setup = beliefs_->setup;
  feet_.Hear(y);
  const StandingFeet::Readings readings = feet_.Read(y, *beliefs_);
  if (setup.leg_correction == LegCorrection::kVelocity) return UseAsVelocity(m, readings, report);
  WatchSlip(readings);
  CorrectFeet(m, readings, report);
  for (std::size_t i = 0; i < setup.suite.legs->legs.size(); ++i) {
    const Slot foot = FootSlot(static_cast<int>(i));
    if (!feet_.Stands(i) || core_.P().IsActive(foot)) continue;
    AddFoot(core_, readings[i], foot);
    if (!setup.floor.use) continue;
    UseFloor(
        m, foot, [foot](const NavigationState& x) { return x.At(foot); }, report);
  }
}

/// A velocity for each foot: that of the point of contact, which stands.
template <class Core>
void InOrderFilter<Core>::UseAsVelocity(const Measurement& m,
                                        const StandingFeet::Readings& readings, Report* report) {
  const Noise& noise = beliefs_->setup.noise;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!feet_.Stands(i)) continue;
    const auto model = [&](const NavigationState& x) {
      return LinearisedLegOdometry(readings[i], beliefs_->rolling_radius_m, noise, Turn(), x);
    };
    Apply(m.valid_ns, m.sensor, model, report);
  }
}

/// Which feet slip: by the speed of their points of contact, or by the NIS of the velocity that the
/// body would have if they stood.
template <class Core>
void InOrderFilter<Core>::WatchSlip(const StandingFeet::Readings& readings) {
  const SlipRejection& told = beliefs_->setup.slip;
  if (told.rule == SlipRule::kOff) return;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    slips_[i] = false;
    if (!feet_.Stands(i)) continue;
    const auto odometry =
        Core::Convert(LinearisedLegOdometry(readings[i], beliefs_->rolling_radius_m,
                                            beliefs_->setup.noise, Turn(), core_.x()),
                      core_.x());
    slip_.col(static_cast<Eigen::Index>(i)) = odometry.z;
    slips_[i] = told.rule == SlipRule::kSpeed
                    ? odometry.z.norm() > told.speed_m_s
                    : KalmanCorrection<3>(core_.P(), odometry).nis() > beliefs_->slip_limit;
  }
}

/// Linearised once and taken in one after the other: equal to all feet in one correction.
template <class Core>
void InOrderFilter<Core>::CorrectFeet(const Measurement& m, const StandingFeet::Readings& readings,
                                      Report* report) {
  if (core_.P().slots().feet().empty()) return;
  SlotVector increment;
  increment.fill(Lane::Zero());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Slot foot = FootSlot(static_cast<int>(i));
    if (!feet_.Stands(i) || !core_.P().IsActive(foot)) continue;
    const auto linearised = LinearisedContact(readings[i], foot, core_.x());
    auto own = Core::Convert(linearised, core_.x());
    own.MoveBy(increment);
    const bool slips = beliefs_->setup.slip.rule == SlipRule::kNis && slips_[i];
    if (slips) Excuse(m, foot, own, report);
    if (!core_.P().IsActive(foot)) continue;
    IfItFits(
        m.valid_ns, m.sensor, own, linearised.slots(),
        [&](const KalmanCorrection<3>& kalman, Decision /*decision*/) {
          kalman.AddGainTo(increment);
          kalman.UpdateCovariance(core_.P());
        },
        slips ? nullptr : report);
  }
  core_.Retract(increment);
}

/// A foot that slips is forgotten, to be added anew, or its own belief is widened by Q = 2 τ Δt z
/// zᵀ: what a slip of velocity z and correlation time τ adds to it in Δt, so that most of the
/// innovation moves the foot.
template <class Core>
void InOrderFilter<Core>::Excuse(const Measurement& m, Slot foot, const Linearisation<3>& own,
                                 Report* report) {
  const SlipRejection& told = beliefs_->setup.slip;
  Correction correction = Described(KalmanCorrection<3>(core_.P(), own), own, core_.x().R);
  correction.t_ns = m.valid_ns;
  correction.sensor = m.sensor;
  const bool drops = told.action == SlipAction::kDrop;
  correction.decision = drops ? Decision::kRejected : Decision::kInflated;
  if (report != nullptr) report->Add(correction);
  if (drops) return core_.P().RemoveFoot(foot);
  const Vector3d z = slip_.col(foot - kFirstFootSlot);
  const double dt = models::Seconds(beliefs_->setup.suite.sensors[m.sensor].period_ns);
  core_.P()(foot, foot) += ToLanes(2.0 * told.correlation_s * dt * z * z.transpose());
}

/// A standing foot moves a little all the time, and more while it is too fast to stand.
template <class Core>
void InOrderFilter<Core>::AddFootNoise(double dt) {
  const Setup& setup = beliefs_->setup;
  const double density = setup.noise.foot_slip_m_per_s_sqrt_hz;
  for (const Slot slot : core_.P().active()) {
    if (!IsFoot(slot)) continue;
    const bool fast = setup.slip.rule == SlipRule::kSpeed && slips_[slot - kFirstFootSlot];
    const double factor = fast ? setup.slip.factor : 1.0;
    core_.P()(slot, slot) += LaneMatrix::Diagonal(factor * density * density * dt);
  }
}

template <class Core>
void InOrderFilter<Core>::LiftFeet() {
  for (int i = 0; i < kMaxFeet; ++i) {
    const Slot foot = FootSlot(i);
    if (!feet_.Stands(static_cast<std::size_t>(i)) && core_.P().IsActive(foot))
      core_.P().RemoveFoot(foot);
  }
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& /*m*/, const models::ContactSample& y,
                              Report* /*report*/) {
  feet_.Hear(y);
  LiftFeet();
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::TorqueSample& y,
                              Report* /*report*/) {
  const Vector3d a = held_.accel() - core_.x().accel_bias;
  feet_.Weigh(m.valid_ns, y, {Turn().w_rad_s, a, core_.x().R}, *beliefs_);
  LiftFeet();
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::FootForceSample& y,
                              Report* /*report*/) {
  feet_.Weigh(m.valid_ns, y, *beliefs_);
  LiftFeet();
}

template class InOrderFilter<RightInvariantEkf>;
template class InOrderFilter<LeftInvariantEkf>;
template class InOrderFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
