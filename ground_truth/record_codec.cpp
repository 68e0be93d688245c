#include "reckon/ground_truth/record_codec.h"

#include <fmt/format.h>

#include <limits>

#include "reckon/ground_truth/recording_columns.h"
#include "reckon/ground_truth/run_recorder.h"

namespace reckon::ground_truth {
namespace {

/// The next number, which must lie in [least, end).
template <class Stored>
Stored GetWithin(RowDecoder& row, std::string_view column, std::size_t least, std::size_t end) {
  const Stored number = row.Get<Stored>();
  if (number < least || number >= end) {
    throw RecordingError(fmt::format("damaged: {} is {}, expected {} to {}", column, number, least,
                                     static_cast<std::int64_t>(end) - 1));
  }
  return number;
}

/// The next number as the entry of a list of names that it stands for.
template <class Enum>
Enum GetNamed(RowDecoder& row, std::string_view column, std::span<const std::string_view> names) {
  return static_cast<Enum>(GetWithin<std::uint8_t>(row, column, 0, names.size()));
}

models::SensorId GetSensor(RowDecoder& row, std::size_t sensors) {
  return GetWithin<models::SensorId>(row, "sensor", 0, sensors);
}

void Put(const models::ImuSample& sample, RowEncoder& row) {
  row.Put(sample.gyro_rad_s);
  row.Put(sample.accel_m_s2);
  row.Put(sample.interval_ns);
  row.Put(sample.gyro_saturated);
  row.Put(sample.accel_saturated);
}

void Put(const models::EncoderSample& sample, RowEncoder& row) {
  for (int i = 0; i < sample.angle_rad.size(); ++i) row.Put(sample.angle_rad[i]);
  for (int i = 0; i < sample.rate_rad_s.size(); ++i) row.Put(sample.rate_rad_s[i]);
  row.Put(sample.interval_ns);
}

void Put(const models::BodyVelocitySample& sample, RowEncoder& row) {
  row.Put(sample.v_WS_S);
  row.Put(sample.covariance);
  row.Put(sample.valid);
  row.Put(sample.over_ground);
  row.Put(sample.figure_of_merit_m_s);
  row.Put(sample.beams);
}

void Put(const models::DepthSample& sample, RowEncoder& row) { row.Put(sample.depth_m); }

void Put(const models::PoseSample& sample, RowEncoder& row) {
  row.Put(sample.X_WS.R);
  row.Put(sample.X_WS.p);
  row.Put(sample.position_sigma_m);
  row.Put(sample.orientation_sigma_rad);
  row.Put(sample.has_orientation);
}

void Put(const models::ContactSample& sample, RowEncoder& row) {
  for (const double probability : sample.probability) row.Put(probability);
}

void Put(const models::TorqueSample& sample, RowEncoder& row) {
  for (const double torque : sample.torque_n_m) row.Put(torque);
}

void Put(const models::FootForceSample& sample, RowEncoder& row) {
  for (const double force : sample.force_n) row.Put(force);
}

template <class Vector>
Vector GetChannels(RowDecoder& row, int channels) {
  Vector values(channels);
  for (double& value : values) value = row.Get<double>();
  return values;
}

models::Sample GetImu(RowDecoder& row) {
  models::ImuSample sample;
  sample.gyro_rad_s = row.Vector();
  sample.accel_m_s2 = row.Vector();
  sample.interval_ns = row.Get<models::TimeNs>();
  sample.gyro_saturated = row.Flag();
  sample.accel_saturated = row.Flag();
  return sample;
}

models::Sample GetEncoders(RowDecoder& row, int channels) {
  models::EncoderSample sample;
  sample.angle_rad = GetChannels<models::EncoderVector>(row, channels);
  sample.rate_rad_s = GetChannels<models::EncoderVector>(row, channels);
  sample.interval_ns = row.Get<models::TimeNs>();
  return sample;
}

models::Sample GetBodyVelocity(RowDecoder& row) {
  models::BodyVelocitySample sample;
  sample.v_WS_S = row.Vector();
  sample.covariance = row.Matrix();
  sample.valid = row.Flag();
  sample.over_ground = row.Flag();
  sample.figure_of_merit_m_s = row.Get<double>();
  sample.beams = row.Get<std::uint8_t>();
  return sample;
}

models::Sample GetDepth(RowDecoder& row) { return models::DepthSample{row.Get<double>()}; }

models::Sample GetPoseSample(RowDecoder& row) {
  models::PoseSample sample;
  sample.X_WS.R = row.Matrix();
  sample.X_WS.p = row.Vector();
  sample.position_sigma_m = row.Vector();
  sample.orientation_sigma_rad = row.Vector();
  sample.has_orientation = GetWithin<std::uint8_t>(row, "has_orientation", 0, 2) != 0;
  return sample;
}

template <class State>
void PutPose(const State& state, RowEncoder& row) {
  row.Put(state.t_ns);
  row.Put(state.X_WB.R);
  row.Put(state.X_WB.p);
  row.Put(state.v_WB);
}

template <class State>
void GetPose(State& state, RowDecoder& row) {
  state.t_ns = row.Get<models::TimeNs>();
  state.X_WB.R = row.Matrix();
  state.X_WB.p = row.Vector();
  state.v_WB = row.Vector();
}

template <class State>
void PutBiases(const State& state, RowEncoder& row) {
  row.Put(state.gyro_bias_rad_s);
  row.Put(state.accel_bias_m_s2);
}

template <class State>
void GetBiases(State& state, RowDecoder& row) {
  state.gyro_bias_rad_s = row.Vector();
  state.accel_bias_m_s2 = row.Vector();
}

}  // namespace

void Encode(const Truth& truth, RowEncoder& row) {
  PutPose(truth, row);
  row.Put(truth.w_WB_B);
  PutBiases(truth, row);
  for (int i = 0; i < truth.wheel_rate_rad_s.size(); ++i) {
    row.Put(truth.wheel_rate_rad_s[i]);
    row.Put(truth.wheel_slip_m_s[i]);
    row.Put(truth.wheel_load_n[i]);
  }
  for (int i = 0; i < truth.feet.count; ++i) {
    const FootTruth& foot = truth.feet.foot[i];
    row.Put(foot.contact);
    row.Put(foot.normal_n);
    row.Put(foot.tangential_n);
    row.Put(foot.slip_m_s);
    row.Put(foot.centre_m_s);
    row.Put(foot.normal);
  }
}

void Encode(const models::Measurement& measurement, std::uint64_t order, RowEncoder& row) {
  row.Put(order);
  row.Put(measurement.valid_ns);
  row.Put(measurement.arrival_ns);
  std::visit([&row](const auto& sample) { Put(sample, row); }, measurement.sample);
}

void Encode(const estimator::Estimate& estimate, std::int64_t covariance_row, int feet,
            RowEncoder& row) {
  PutPose(estimate, row);
  PutBiases(estimate, row);
  row.Put(covariance_row);
  row.Put(static_cast<std::uint8_t>(estimate.form));
  row.Put(estimate.has_covariance);
  row.Put(estimate.has_biases);
  const bool says = estimate.contact.size() == feet;
  for (int i = 0; i < feet; ++i) {
    row.Put(says ? estimate.contact[i] : std::numeric_limits<double>::quiet_NaN());
  }
}

void Encode(const estimator::Correction& correction, std::uint64_t order, RowEncoder& row) {
  row.Put(correction.t_ns);
  row.Put(order);
  row.Put(correction.sensor);
  row.Put(static_cast<std::uint8_t>(correction.decision));
  row.Put(static_cast<std::uint8_t>(correction.reason));
  row.Put(static_cast<std::uint8_t>(correction.rows));
  row.Put(correction.innovation);
  row.PutSymmetric(correction.covariance);
  row.Put(correction.nis);
}

void Encode(const models::Measurement& measurement, estimator::Refusal reason, std::uint64_t order,
            RowEncoder& row) {
  row.Put(measurement.valid_ns);
  row.Put(measurement.arrival_ns);
  row.Put(order);
  row.Put(measurement.sensor);
  row.Put(static_cast<std::uint8_t>(reason));
}

void Encode(const estimator::Prior& prior, RowEncoder& row) {
  PutPose(prior, row);
  row.Put(prior.w_WB_B);
  PutBiases(prior, row);
}

Truth DecodeTruth(RowDecoder& row, int wheels, int feet) {
  Truth truth;
  GetPose(truth, row);
  truth.w_WB_B = row.Vector();
  GetBiases(truth, row);
  truth.has_biases = truth.gyro_bias_rad_s.allFinite() && truth.accel_bias_m_s2.allFinite();
  truth.wheel_rate_rad_s.resize(wheels);
  truth.wheel_slip_m_s.resize(wheels);
  truth.wheel_load_n.resize(wheels);
  for (int i = 0; i < wheels; ++i) {
    truth.wheel_rate_rad_s[i] = row.Get<double>();
    truth.wheel_slip_m_s[i] = row.Get<double>();
    truth.wheel_load_n[i] = row.Get<double>();
  }
  truth.feet.count = feet;
  for (int i = 0; i < feet; ++i) {
    FootTruth& foot = truth.feet.foot[i];
    foot.contact = row.Flag();
    foot.normal_n = row.Get<double>();
    foot.tangential_n = row.Get<double>();
    foot.slip_m_s = row.Get<double>();
    foot.centre_m_s = row.Get<double>();
    foot.normal = row.Vector();
  }
  return truth;
}

models::Measurement DecodeMeasurement(RowDecoder& row, models::SensorId sensor,
                                      models::SensorKind kind, int channels, std::uint64_t* order) {
  models::Measurement measurement;
  measurement.sensor = sensor;
  *order = row.Get<std::uint64_t>();
  measurement.valid_ns = row.Get<models::TimeNs>();
  measurement.arrival_ns = row.Get<models::TimeNs>();
  switch (kind) {
    case models::SensorKind::kImu:
      measurement.sample = GetImu(row);
      break;
    case models::SensorKind::kEncoders:
      measurement.sample = GetEncoders(row, channels);
      break;
    case models::SensorKind::kBodyVelocity:
      measurement.sample = GetBodyVelocity(row);
      break;
    case models::SensorKind::kDepth:
      measurement.sample = GetDepth(row);
      break;
    case models::SensorKind::kPose:
      measurement.sample = GetPoseSample(row);
      break;
    case models::SensorKind::kContacts:
      measurement.sample = models::ContactSample{GetChannels<models::FootVector>(row, channels)};
      break;
    case models::SensorKind::kTorques:
      measurement.sample = models::TorqueSample{GetChannels<models::EncoderVector>(row, channels)};
      break;
    case models::SensorKind::kFootForces:
      measurement.sample = models::FootForceSample{GetChannels<models::FootVector>(row, channels)};
      break;
  }
  return measurement;
}

estimator::Estimate DecodeEstimate(RowDecoder& row, int feet, std::int64_t* covariance_row) {
  estimator::Estimate estimate;
  GetPose(estimate, row);
  GetBiases(estimate, row);
  *covariance_row = row.Get<std::int64_t>();
  estimate.form = GetNamed<estimator::ErrorForm>(row, "error_form", ErrorFormNames());
  estimate.has_covariance = row.Flag();
  estimate.has_biases = row.Flag();
  estimate.contact = GetChannels<models::FootVector>(row, feet);
  if (!estimate.contact.allFinite()) estimate.contact.resize(0);
  return estimate;
}

estimator::Correction DecodeCorrection(RowDecoder& row, std::size_t sensors) {
  estimator::Correction correction;
  correction.t_ns = row.Get<models::TimeNs>();
  (void)row.Get<std::uint64_t>();
  correction.sensor = GetSensor(row, sensors);
  correction.decision = GetNamed<estimator::Decision>(row, "decision", DecisionNames());
  correction.reason = GetNamed<estimator::Refusal>(row, "reason", RefusalNames());
  correction.rows = GetWithin<std::uint8_t>(row, "rows", 1, estimator::kMaxRows + 1);
  correction.innovation = row.Vector();
  row.GetSymmetric(correction.covariance);
  correction.nis = row.Get<double>();
  return correction;
}

RefusedMeasurement DecodeRefusal(RowDecoder& row, std::size_t sensors) {
  RefusedMeasurement refused;
  refused.valid_ns = row.Get<models::TimeNs>();
  refused.arrival_ns = row.Get<models::TimeNs>();
  (void)row.Get<std::uint64_t>();
  refused.sensor = GetSensor(row, sensors);
  refused.reason = GetNamed<estimator::Refusal>(row, "reason", RefusalNames());
  return refused;
}

estimator::Prior DecodePrior(RowDecoder& row) {
  estimator::Prior prior;
  GetPose(prior, row);
  prior.w_WB_B = row.Vector();
  GetBiases(prior, row);
  return prior;
}

}  // namespace reckon::ground_truth
