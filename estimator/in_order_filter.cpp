#include "reckon/estimator/in_order_filter.h"

#include <algorithm>
#include <cmath>

#include "reckon/estimator/correction_judge.h"
#include "reckon/estimator/depth_model.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/iterated_correction.h"
#include "reckon/estimator/kalman.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/pose_model.h"
#include "reckon/estimator/reanchoring.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/standstill_model.h"
#include "reckon/estimator/wheel_model.h"
#include "reckon/estimator/yaw_rate_model.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using models::Measurement;
using models::TimeNs;

/// No step is longer: the covariance of a bridged gap sees its nonlinearity.
constexpr TimeNs kLongestStep = 50'000'000;

double LargestSigma(const LaneMatrix& P) {
  return std::sqrt(std::max({P(0, 0), P(1, 1), P(2, 2)}));
}

void Forget(ErrorCovariance& P, ErrorBlock block) {
  P.middleRows<3>(block).setZero();
  P.middleCols<3>(block).setZero();
}

}  // namespace

template <class Core>
InOrderFilter<Core>::InOrderFilter(const FilterBeliefs& beliefs)
    : beliefs_(&beliefs),
      stage_(beliefs.stage_noise),
      rest_(beliefs.setup.noise, models::Seconds(beliefs.period_ns), beliefs.setup.gravity_m_s2),
      mistrust_(beliefs.setup.gate.patience_s) {}

template <class Core>
void InOrderFilter<Core>::Start(TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P) {
  ErrorCovariance kept = P;
  if (!beliefs_->setup.estimate_gyro_bias) Forget(kept, kGyroBias);
  if (!beliefs_->setup.estimate_accel_bias) Forget(kept, kAccelBias);
  core_.Start(x, kept);
  if (beliefs_->gyro_source_is_imu && beliefs_->setup.estimate_gyro_bias) StartMeanBias();
  stage_.Start();
  t_ns_ = t_ns;
  held_.Start(t_ns);
  widening_ = {};
  rest_.Restart();
  mistrust_.Start(t_ns);
  feet_.Start();
}

/// With a second IMU the filter's bias is the mean of two: of the other nothing is known but that
/// it is small.
template <class Core>
void InOrderFilter<Core>::StartMeanBias() {
  const LaneMatrix half = LaneMatrix::Diagonal(0.5);
  core_.P().MapRow(kGyroBiasSlot, half);
  core_.x().gyro_bias *= 0.5;
  const double sigma = beliefs_->setup.gyro_filter.bias_sigma_rad_s;
  core_.P()(kGyroBiasSlot, kGyroBiasSlot) += LaneMatrix::Diagonal(0.25 * sigma * sigma);
}

template <class Core>
TimeNs InOrderFilter<Core>::Hold(TimeNs valid_ns, const models::ImuSample& sample) {
  held_.Take(t_ns_, valid_ns, sample, beliefs_->R_BS_imu);
  if (beliefs_->gyro_source) stage_.Advance(held_.gyro(), models::Seconds(valid_ns - t_ns_));
  const TimeNs bridged_ns = held_.covered_from_ns() - t_ns_;
  if (bridged_ns > 0) rest_.Restart();
  return bridged_ns;
}

template <class Core>
ProcessNoise InOrderFilter<Core>::NoiseAt(TimeNs t_ns) const {
  ProcessNoise seen = beliefs_->noise;
  if (beliefs_->gyro_source && t_ns >= held_.covered_from_ns()) {
    seen.gyro = stage_.white_variance() * held_.seconds();
  }
  return held_.NoiseAt(t_ns, seen);
}

template <class Core>
void InOrderFilter<Core>::AdvanceTo(TimeNs t_ns) {
  const double slip = beliefs_->setup.noise.foot_slip_m_per_s_sqrt_hz;
  while (t_ns_ < t_ns) {
    TimeNs until_ns = std::min(t_ns_ + kLongestStep, t_ns);
    if (t_ns_ < held_.covered_from_ns()) until_ns = std::min(until_ns, held_.covered_from_ns());
    const double dt = models::Seconds(until_ns - t_ns_);
    const Increment u(Rate() - core_.x().gyro_bias, held_.accel() - core_.x().accel_bias, dt);
    ProcessNoise noise = NoiseAt(t_ns_);
    widening_.Spend(noise, core_.P(), dt);
    if (beliefs_->rolling_radius_m > 0.0 && !core_.P().slots().feet().empty()) {
      const RollingFeet rolling = feet_.Rolling(u.w, core_.x(), beliefs_->rolling_radius_m);
      core_.Propagate(u, beliefs_->gravity, noise, &rolling);
    } else {
      core_.Propagate(u, beliefs_->gravity, noise);
    }
    for (const Slot slot : core_.P().active()) {
      if (IsFoot(slot)) core_.P()(slot, slot) += LaneMatrix::Diagonal(slip * slip * dt);
    }
    t_ns_ = until_ns;
  }
}

template <class Core>
void InOrderFilter<Core>::CoastTo(TimeNs t_ns) {
  held_.Coast(t_ns_, t_ns);
  AdvanceTo(t_ns);
}

template <class Core>
TurnRate InOrderFilter<Core>::Turn() const {
  double variance = held_.seconds() > 0.0 ? beliefs_->noise.gyro / held_.seconds() : 0.0;
  if (beliefs_->gyro_source) variance = stage_.white_variance();
  return {Rate() - core_.x().gyro_bias, variance};
}

template <class Core>
void InOrderFilter<Core>::Refine(const Measurement& m, Report* report) {
  if (const auto* imu = std::get_if<models::ImuSample>(&m.sample)) {
    return RefineByImu(m, *imu, report);
  }
  const models::WheelDrive& wheels = *beliefs_->setup.suite.wheels;
  const auto rates = MeanRates(std::get<models::EncoderSample>(m.sample), wheels);
  const double sigma = beliefs_->setup.noise.wheel_yaw_rate_rad_per_s;
  const double yaw_rate = WheelYawRate(*rates, wheels), w_z = stage_.rate().z();
  const double variance = sigma * sigma + stage_.white_variance(2);
  const auto applied = Apply(
      m.valid_ns, m.sensor,
      [&](const NavigationState& x) { return LinearisedYawRate(yaw_rate, w_z, variance, x); },
      report);
  if (applied) stage_.CorrectNoise(2, applied->innovation[0], applied->covariance(0, 0));
}

template <class Core>
void InOrderFilter<Core>::RefineByImu(const Measurement& m, const models::ImuSample& y,
                                      Report* report) {
  const Vector3d beta = beliefs_->X_IS[m.sensor].R * y.gyro_rad_s;
  const double variance = beliefs_->noise.gyro / models::Seconds(y.interval_ns);
  Correction correction{.t_ns = m.valid_ns, .sensor = m.sensor, .rows = 3};
  for (int i = 0; i < 3; ++i) {
    const auto [z, S] = stage_.Expect(i, beta[i], variance);
    correction.innovation[i] = z;
    correction.covariance(i, i) = S;
    correction.nis += z * z / S;
  }
  correction.decision = beliefs_->gate.Judge(3, correction.nis);
  // There is no half belief in a second rate: its noise is the first one's.
  if (correction.decision == Decision::kInflated) correction.decision = Decision::kRejected;
  if (report != nullptr) report->Add(correction);
  if (correction.decision == Decision::kRejected) return;
  for (int i = 0; i < 3; ++i) stage_.Correct(i, beta[i], variance);
}

template <class Core>
void InOrderFilter<Core>::Correct(const Measurement& measurement, Report* report) {
  std::visit([&](const auto& sample) { Use(measurement, sample, report); }, measurement.sample);
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::BodyVelocitySample& y,
                              Report* report) {
  models::BodyVelocitySample believed = y;
  believed.covariance = beliefs_->CovarianceOf(y);
  const auto model = [&](const NavigationState& x) {
    return LinearisedVelocity(believed, beliefs_->X_IS[m.sensor], Turn(), x);
  };
  Apply(m.valid_ns, m.sensor, model, report);
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::EncoderSample& y,
                              Report* report) {
  if (RestAverage::IsMotion(y.rate_rad_s.cwiseAbs().maxCoeff())) rest_.Restart();
  if (m.sensor == beliefs_->leg_encoders) return UseLegs(m, y, report);
  const models::WheelDrive& wheels = *beliefs_->setup.suite.wheels;
  const auto velocity = WheelVelocity(*MeanRates(y, wheels), wheels, beliefs_->setup.noise);
  const auto model = [&](const NavigationState& x) {
    return LinearisedVelocity(velocity, beliefs_->X_IS[m.sensor], Turn(), x);
  };
  Apply(m.valid_ns, m.sensor, model, report);
  if (!beliefs_->setup.floor.use) return;
  const Vector3d r_IB = -beliefs_->p_BI;
  UseFloor(
      m, kPositionSlot, [r_IB](const NavigationState& x) { return x.p + x.R * r_IB; }, report);
}

template <class Core>
void InOrderFilter<Core>::UseLegs(const Measurement& m, const models::EncoderSample& y,
                                  Report* report) {
  const auto& legs = beliefs_->setup.suite.legs->legs;
  const StandingFeet::Readings readings = feet_.Read(y, *beliefs_);
  CorrectFeet(m, readings, report);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Slot foot = FootSlot(static_cast<int>(i));
    if (!feet_.Stands(i) || core_.P().IsActive(foot)) continue;
    AddFoot(core_, readings[i], foot);
    if (!beliefs_->setup.floor.use) continue;
    UseFloor(
        m, foot, [foot](const NavigationState& x) { return x.At(foot); }, report);
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
    IfItFits(
        m.valid_ns, m.sensor, own, linearised.slots(),
        [&](const KalmanCorrection<3>& kalman, Decision /*decision*/) {
          kalman.AddGainTo(increment);
          kalman.UpdateCovariance(core_.P());
        },
        report);
  }
  core_.Retract(increment);
}

template <class Core>
template <class Point>
void InOrderFilter<Core>::UseFloor(const Measurement& m, Slot slot, const Point& point,
                                   Report* report) {
  const Setup& setup = beliefs_->setup;
  const auto model = [&](const NavigationState& x) {
    return LinearisedHeight(setup.floor.height_m, setup.noise.floor_height_m, slot, point(x));
  };
  Apply(m.valid_ns, m.sensor, model, report);
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::DepthSample& y, Report* report) {
  const auto model = [&](const NavigationState& x) {
    auto height = LinearisedDepth(y, beliefs_->X_IS[m.sensor].p, beliefs_->setup.noise.depth_m, x);
    core_.AddCurvature(beliefs_->X_IS[m.sensor].p, beliefs_->SamplesOfOneTilt(m.sensor), height);
    return height;
  };
  Apply(m.valid_ns, m.sensor, model, report);
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& m, const models::PoseSample& y, Report* report) {
  const models::Pose& X_IS = beliefs_->X_IS[m.sensor];
  const double scale = beliefs_->setup.noise.pose_scale;
  Apply(
      m.valid_ns, m.sensor,
      [&](const NavigationState& x) { return LinearisedPosition(y, X_IS, scale, x); }, report);
  const auto yaw = LinearisedYaw(y, X_IS, scale, core_.x());
  if (!yaw) return;
  Apply(
      m.valid_ns, m.sensor,
      [&](const NavigationState& x) { return LinearisedYaw(y, X_IS, scale, x).value_or(*yaw); },
      report);
}

template <class Core>
void InOrderFilter<Core>::Use(const Measurement& /*m*/, const models::ContactSample& y,
                              Report* /*report*/) {
  feet_.Hear(y);
  for (Eigen::Index i = 0; i < y.probability.size(); ++i) {
    const Slot foot = FootSlot(static_cast<int>(i));
    if (!feet_.Stands(static_cast<std::size_t>(i)) && core_.P().IsActive(foot))
      core_.P().RemoveFoot(foot);
  }
}

template <class Core>
void InOrderFilter<Core>::EndSample(Report* report) {
  const Setup& setup = beliefs_->setup;
  if (!setup.standstill.use) return;
  rest_.Add(held_.gyro(), held_.accel(), held_.seconds());
  if (!rest_.CanTell()) return;
  const Vector3d bias_of_first = BiasOfFirst();
  if (rest_.LooksMoving({bias_of_first, core_.x().accel_bias,
                         LargestSigma(core_.P()(kGyroBiasSlot, kGyroBiasSlot)),
                         LargestSigma(core_.P()(kAccelBiasSlot, kAccelBiasSlot))})) {
    return rest_.Restart();
  }
  if (rest_.seconds() + 0.5 * held_.seconds() < setup.standstill.window_s) return;
  Apply(
      t_ns_, beliefs_->imu,
      [&](const NavigationState& x) {
        return LinearisedZeroVelocity(setup.noise.standstill_m_per_s, x);
      },
      report);
  if (setup.estimate_gyro_bias) {
    const double sigma = setup.noise.standstill_rad_per_s;
    const double variance = rest_.gyro_sigma() * rest_.gyro_sigma() / rest_.count() + sigma * sigma;
    const Vector3d w = rest_.gyro() - bias_of_first + core_.x().gyro_bias;
    Apply(
        t_ns_, beliefs_->imu,
        [&](const NavigationState& x) { return LinearisedZeroRate(w, variance, x); }, report);
  }
  rest_.Restart();
}

template <class Core>
void InOrderFilter<Core>::Blame(Correction& correction) {
  if (correction.decision == Decision::kRefused) return;
  const bool rejected = correction.decision == Decision::kRejected;
  mistrust_.Heard(t_ns_, correction.rows, rejected);
  if (!rejected || !mistrust_.OfBelief()) return;
  correction.decision = Decision::kWidened;
  const double seconds = mistrust_.seconds();
  widening_ = {seconds, kUnseenAcceleration * seconds + correction.innovation.norm()};
  mistrust_.Start(t_ns_);
}

template <class Core>
template <int kRows, class Taken>
std::optional<Correction> InOrderFilter<Core>::IfItFits(TimeNs t_ns, models::SensorId sensor,
                                                        const Linearisation<kRows>& own,
                                                        SlotSet seen, const Taken& use,
                                                        Report* report) {
  KalmanCorrection<kRows> kalman(core_.P(), own);
  Correction correction = Described(kalman, own, core_.x().R);
  correction.t_ns = t_ns;
  correction.sensor = sensor;
  Judge(beliefs_->gate, core_, seen, correction);
  Blame(correction);
  if (report != nullptr) report->Add(correction);
  if (!IsApplied(correction.decision)) return std::nullopt;
  kalman.AddLasting();
  if (correction.decision == Decision::kInflated) kalman.Inflate(beliefs_->gate.Limit(kRows));
  use(kalman, correction.decision);
  return correction;
}

template <class Core>
template <class Model>
std::optional<Correction> InOrderFilter<Core>::Apply(TimeNs t_ns, models::SensorId sensor,
                                                     const Model& model, Report* report) {
  const auto linearised = model(core_.x());
  constexpr int kRows = std::decay_t<decltype(linearised)>::Vector::RowsAtCompileTime;
  const auto use = [&](const KalmanCorrection<kRows>& kalman, Decision decision) {
    const int iterations = beliefs_->setup.iterations;
    if constexpr (Core::kForm == ErrorForm::kRightInvariant) {
      if (iterations > 1 && decision != Decision::kInflated) {
        return CorrectIterated<kRows>(core_, model, iterations);
      }
    }
    core_.Retract(kalman.Gain());
    kalman.UpdateCovariance(core_.P());
  };
  return IfItFits(t_ns, sensor, Core::Convert(linearised, core_.x()), linearised.slots(), use,
                  report);
}

template <class Core>
void InOrderFilter<Core>::StartAgain(TimeNs t_ns, const Vector3d& up_I) {
  NavigationState x = core_.x();
  x.gyro_bias = BiasOfFirst();
  const Reanchored after =
      Reanchor(x, core_.P().Dense(), beliefs_->noise, up_I, models::Seconds(t_ns - t_ns_));
  Start(t_ns, after.x, after.P);
}

template <class Core>
Estimate InOrderFilter<Core>::Belief() const {
  const NavigationState& x = core_.x();
  const TurnRate turn = Turn();
  const Vector3d r_IB = -beliefs_->p_BI;
  Estimate estimate;
  estimate.t_ns = t_ns_;
  estimate.X_WB = {x.R, x.p + x.R * r_IB};
  estimate.v_WB = x.v + x.R * turn.w_rad_s.cross(r_IB);
  estimate.gyro_bias_rad_s = BiasOfFirst();
  estimate.accel_bias_m_s2 = x.accel_bias;
  estimate.form = Core::kForm;
  estimate.has_covariance = true;
  estimate.has_biases = true;
  estimate.covariance = core_.BodyCovariance(r_IB, turn.w_rad_s, turn.variance);
  return estimate;
}

template class InOrderFilter<RightInvariantEkf>;
template class InOrderFilter<LeftInvariantEkf>;
template class InOrderFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
