#include "reckon/estimator/imu_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reckon/estimator/kalman.h"
#include "reckon/estimator/sample_checks.h"
#include "reckon/estimator/setup_checks.h"

namespace reckon::estimator {
namespace {

using models::Measurement;
using models::TimeNs;

constexpr TimeNs kLeastTolerance = 15'000'000;
/// A motion nobody saw, one sigma of a constant rate and acceleration beside the held sample.
constexpr double kUnseenRate = 0.5;          ///< rad/s
constexpr double kUnseenAcceleration = 3.0;  ///< m/s²
/// No step is longer: the covariance of a bridged gap sees its nonlinearity.
constexpr TimeNs kLongestStep = 50'000'000;
/// A correction that is further ahead of the IMU is not worth waiting for.
constexpr TimeNs kLongestWait = models::kNsPerSecond;
/// A clipped sample says little: its noise is taken this many times larger.
constexpr double kSaturatedFactor = 100.0;

models::SensorId PrimaryImu(const models::Suite& suite) {
  for (std::size_t i = 0; i < suite.sensors.size(); ++i) {
    if (suite.sensors[i].kind == models::SensorKind::kImu) return static_cast<models::SensorId>(i);
  }
  throw std::invalid_argument("this estimator needs an IMU, and the suite has none");
}

ProcessNoise Squared(const Noise& n) {
  const auto square = [](double x) { return x * x; };
  return {square(n.gyro_noise_density_rad_per_s_sqrt_hz),
          square(n.accel_noise_density_m_per_s2_sqrt_hz),
          square(n.gyro_bias_walk_rad_per_s2_sqrt_hz), square(n.accel_bias_walk_m_per_s3_sqrt_hz)};
}

}  // namespace

template <class Core>
ImuFilter<Core>::ImuFilter(const Setup& setup)
    : setup_(setup),
      gate_(setup.gate),
      noise_(Squared(setup.noise)),
      gravity_(0, 0, -setup.gravity_m_s2),
      imu_(PrimaryImu(setup.suite)),
      R_BS_(setup.suite.sensors[imu_].X_BS.R),
      p_BI_(setup.suite.sensors[imu_].X_BS.p),
      period_ns_(setup.suite.sensors[imu_].period_ns),
      tolerance_ns_(std::max(kLeastTolerance, 3 * period_ns_ / 2)),
      static_(setup, models::Seconds(period_ns_)) {
  CheckSetup(setup);
  if (period_ns_ <= 0) throw std::invalid_argument("the IMU's period must be positive");
  if (!setup.estimate_gyro_bias) noise_.gyro_walk = 0.0;
  if (!setup.estimate_accel_bias) noise_.accel_walk = 0.0;
}

template <class Core>
void ImuFilter<Core>::Start(const Prior& prior) {
  CheckPrior(prior);
  held_.Clear();
  started_ = false;
  t_ns_ = prior.t_ns;
  sample_s_ = 0.0;
  if (setup_.initialisation.kind == InitialisationKind::kStatic) {
    static_.Start(prior);
    return;
  }
  NavigationState x;
  x.R = prior.X_WB.R;
  x.p = prior.X_WB * p_BI_;
  x.v = prior.v_WB + prior.X_WB.R * prior.w_WB_B.cross(p_BI_);
  x.gyro_bias = prior.gyro_bias_rad_s;
  x.accel_bias = prior.accel_bias_m_s2;
  gyro_ = prior.w_WB_B + prior.gyro_bias_rad_s;
  Begin(prior.t_ns, x, prior.covariance);
}

/// Error coordinates of the body and of I agree in right-invariant form but for the turn over the
/// lever arm, which the prior takes as known.
template <class Core>
void ImuFilter<Core>::Begin(TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P) {
  ErrorCovariance kept = P;
  const auto forget = [&kept](ErrorBlock block) {
    kept.middleRows<3>(block).setZero();
    kept.middleCols<3>(block).setZero();
  };
  if (!setup_.estimate_gyro_bias) forget(kGyroBias);
  if (!setup_.estimate_accel_bias) forget(kAccelBias);
  core_.Start(x, kept);
  t_ns_ = t_ns;
  started_ = true;
}

template <class Core>
Report ImuFilter<Core>::Process(const Measurement& measurement) {
  Report report;
  report.refusal = WhatIsWrong(measurement, setup_.suite);
  if (report.refusal != Refusal::kNone) return report;
  if (const auto* sample = std::get_if<models::ImuSample>(&measurement.sample)) {
    ProcessImu(measurement, *sample, report);
  } else {
    ProcessOther(measurement, report);
  }
  return report;
}

template <class Core>
void ImuFilter<Core>::ProcessImu(const Measurement& measurement, const models::ImuSample& sample,
                                 Report& report) {
  if (measurement.sensor != imu_) {
    report.refusal = Refusal::kUnused;
    return;
  }
  if (measurement.valid_ns <= t_ns_) {
    report.refusal = Refusal::kBackwards;
    return;
  }
  if (measurement.valid_ns - t_ns_ > kLongestGap) {
    report.refusal = Refusal::kGap;
    return;
  }
  gyro_ = R_BS_ * sample.gyro_rad_s;
  accel_ = R_BS_ * sample.accel_m_s2;
  sample_s_ = models::Seconds(sample.interval_ns);
  if (!started_) {
    Initialise(measurement.valid_ns, sample_s_, report);
    return;
  }
  Move(measurement.valid_ns, sample, report);
}

template <class Core>
void ImuFilter<Core>::Initialise(TimeNs t_ns, double dt, Report& report) {
  t_ns_ = t_ns;
  const auto progress = static_.Add(gyro_, accel_, dt);
  if (progress == StaticInitialiser::Progress::kMoving) report.refusal = Refusal::kMoving;
  if (progress == StaticInitialiser::Progress::kWaiting) report.refusal = Refusal::kNotInitialised;
  if (progress == StaticInitialiser::Progress::kDone) {
    Begin(t_ns, static_.State(p_BI_), static_.Covariance());
  }
}

template <class Core>
void ImuFilter<Core>::Move(TimeNs to_ns, const models::ImuSample& sample, Report& report) {
  // Stamps that jitter by less than half a sample are taken at their word: the sample covers what
  // lies between them.
  const TimeNs from_ns = to_ns - sample.interval_ns;
  if (from_ns - t_ns_ > sample.interval_ns / 2) {
    report.bridged_ns = from_ns - t_ns_;
    const double gap_s = models::Seconds(report.bridged_ns);
    ProcessNoise unseen = noise_;
    unseen.gyro += kUnseenRate * kUnseenRate * gap_s;
    unseen.accel += kUnseenAcceleration * kUnseenAcceleration * gap_s;
    Advance(from_ns, unseen, report);
  }
  ProcessNoise noise = noise_;
  if (sample.gyro_saturated) noise.gyro *= kSaturatedFactor * kSaturatedFactor;
  if (sample.accel_saturated) noise.accel *= kSaturatedFactor * kSaturatedFactor;
  Advance(to_ns, noise, report);
  report.propagated = true;
}

/// Holds the newest sample until `to_ns`, with a stop wherever a correction waits.
template <class Core>
void ImuFilter<Core>::Advance(TimeNs to_ns, const ProcessNoise& noise, Report& report) {
  while (t_ns_ < to_ns) {
    TimeNs until_ns = std::min(t_ns_ + kLongestStep, to_ns);
    if (held_.HasUntil(until_ns)) until_ns = held_.first_ns();
    const Increment u(gyro_ - core_.x().gyro_bias, accel_ - core_.x().accel_bias,
                      models::Seconds(until_ns - t_ns_));
    core_.Propagate(u, gravity_, noise);
    t_ns_ = until_ns;
    while (held_.HasUntil(t_ns_)) Correct(held_.Take(), report);
  }
}

template <class Core>
void ImuFilter<Core>::ProcessOther(const Measurement& measurement, Report& report) {
  if (!started_) {
    report.refusal = Refusal::kNotInitialised;
    if (const auto* sample = std::get_if<models::EncoderSample>(&measurement.sample)) {
      const double fastest = sample->rate_rad_s.cwiseAbs().maxCoeff();
      if (!static_.AddWheelRate(fastest)) report.refusal = Refusal::kMoving;
    }
    return;
  }
  if (!VelocityOf(measurement)) {
    report.refusal = IsWheels(measurement) ? Refusal::kInvalid : Refusal::kUnused;
  } else if (measurement.valid_ns > t_ns_) {
    const bool soon = measurement.valid_ns - t_ns_ <= kLongestWait;
    if (!soon || !held_.Hold(measurement)) report.refusal = Refusal::kFromFuture;
  } else if (t_ns_ - measurement.valid_ns > tolerance_ns_) {
    report.refusal = Refusal::kLate;
  } else {
    Correct(measurement, report);
  }
}

template <class Core>
std::optional<models::BodyVelocitySample> ImuFilter<Core>::VelocityOf(
    const Measurement& measurement) const {
  if (const auto* velocity = std::get_if<models::BodyVelocitySample>(&measurement.sample)) {
    models::BodyVelocitySample scaled = *velocity;
    scaled.covariance *= setup_.noise.body_velocity_scale * setup_.noise.body_velocity_scale;
    return scaled;
  }
  if (!IsWheels(measurement)) return std::nullopt;
  const models::WheelDrive& wheels = *setup_.suite.wheels;
  const auto rates = MeanRates(std::get<models::EncoderSample>(measurement.sample), wheels);
  if (!rates) return std::nullopt;
  return WheelVelocity(*rates, wheels, setup_.noise);
}

template <class Core>
bool ImuFilter<Core>::IsWheels(const Measurement& measurement) const {
  const auto& wheels = setup_.suite.wheels;
  return wheels && wheels->encoders == setup_.suite.sensors[measurement.sensor].name;
}

template <class Core>
models::Pose ImuFilter<Core>::FrameInI(const Measurement& measurement) const {
  const bool wheels = std::holds_alternative<models::EncoderSample>(measurement.sample);
  models::Pose X_IS =
      wheels ? setup_.suite.wheels->X_BS : setup_.suite.sensors[measurement.sensor].X_BS;
  X_IS.p -= p_BI_;
  return X_IS;
}

template <class Core>
TurnRate ImuFilter<Core>::Turn() const {
  const double variance = sample_s_ > 0.0 ? noise_.gyro / sample_s_ : 0.0;
  return {gyro_ - core_.x().gyro_bias, variance};
}

template <class Core>
void ImuFilter<Core>::Correct(const Measurement& measurement, Report& report) {
  const auto velocity = VelocityOf(measurement);
  Apply(measurement, LinearisedVelocity(*velocity, FrameInI(measurement), Turn(), core_.x()),
        report);
}

template <class Core>
void ImuFilter<Core>::Apply(const Measurement& measurement, const Linearisation<3>& linearisation,
                            Report& report) {
  const Linearisation<3>& own = Core::Convert(linearisation, core_.x());
  KalmanCorrection<3> kalman(core_.P(), own);
  Correction correction;
  correction.t_ns = measurement.valid_ns;
  correction.sensor = measurement.sensor;
  correction.rows = 3;
  // In the body's axes, where a reader expects a velocity.
  const Eigen::Matrix3d& R = core_.x().R;
  correction.innovation = R.transpose() * own.z;
  correction.covariance = R.transpose() * kalman.S() * R;
  correction.nis = kalman.nis();
  correction.decision = gate_.Judge(correction.rows, correction.nis);
  if (!std::isfinite(correction.nis)) {
    correction.decision = Decision::kRefused;
    correction.reason = Refusal::kNotFinite;
  }
  if (correction.decision == Decision::kInflated) kalman.Inflate(gate_.Limit(correction.rows));
  if (correction.decision != Decision::kRejected && correction.decision != Decision::kRefused) {
    core_.Retract(kalman.Gain());
    kalman.UpdateCovariance(core_.P());
  }
  report.Add(correction);
}

template <class Core>
std::optional<Estimate> ImuFilter<Core>::Belief() const {
  if (!started_) return std::nullopt;
  const NavigationState& x = core_.x();
  const TurnRate turn = Turn();
  const Eigen::Vector3d r_IB = -p_BI_;
  Estimate estimate;
  estimate.t_ns = t_ns_;
  estimate.X_WB = {x.R, x.p + x.R * r_IB};
  estimate.v_WB = x.v + x.R * turn.w_rad_s.cross(r_IB);
  estimate.gyro_bias_rad_s = x.gyro_bias;
  estimate.accel_bias_m_s2 = x.accel_bias;
  estimate.form = Core::kForm;
  estimate.has_covariance = true;
  estimate.has_biases = true;
  estimate.covariance = core_.BodyCovariance(r_IB, turn.w_rad_s, turn.variance);
  return estimate;
}

template class ImuFilter<RightInvariantEkf>;
template class ImuFilter<LeftInvariantEkf>;
template class ImuFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
