#include "reckon/estimator/in_order_filter.h"

#include <algorithm>
#include <cmath>

#include "reckon/estimator/depth_model.h"
#include "reckon/estimator/in_order_filter_inl.h"
#include "reckon/estimator/pose_model.h"
#include "reckon/estimator/reanchoring.h"
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
  slips_.fill(false);
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
    AddFootNoise(dt);
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
  if (beliefs_->setup.suite.legs) {
    estimate.contact = feet_.Probabilities(beliefs_->setup.suite.legs->legs.size());
  }
  return estimate;
}

template class InOrderFilter<RightInvariantEkf>;
template class InOrderFilter<LeftInvariantEkf>;
template class InOrderFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator
