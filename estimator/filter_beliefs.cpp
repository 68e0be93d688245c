#include "reckon/estimator/filter_beliefs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/estimator/setup_checks.h"
#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {
namespace {

using models::SensorId;
using models::SensorKind;

const Setup& Checked(const Setup& setup) {
  CheckSetup(setup);
  return setup;
}

SensorId PrimaryImu(const models::Suite& suite) {
  for (std::size_t i = 0; i < suite.sensors.size(); ++i) {
    if (suite.sensors[i].kind != SensorKind::kImu) continue;
    if (suite.sensors[i].period_ns > 0) return static_cast<SensorId>(i);
    throw std::invalid_argument("the IMU's period must be positive");
  }
  throw std::invalid_argument("this estimator needs an IMU, and the suite has none");
}

ProcessNoise Squared(const Setup& setup) {
  const auto square = [](double x) { return x * x; };
  const Noise& n = setup.noise;
  ProcessNoise squared{square(n.gyro_noise_density_rad_per_s_sqrt_hz),
                       square(n.accel_noise_density_m_per_s2_sqrt_hz),
                       square(n.gyro_bias_walk_rad_per_s2_sqrt_hz),
                       square(n.accel_bias_walk_m_per_s3_sqrt_hz)};
  if (!setup.estimate_gyro_bias) squared.gyro_walk = 0.0;
  if (!setup.estimate_accel_bias) squared.accel_walk = 0.0;
  return squared;
}

/// Both IMUs' biases are believed to be alike.
GyroFilterNoise StageNoise(const GyroFilter& told, const ProcessNoise& noise, double period_s) {
  const double sigma = told.bias_sigma_rad_s;
  return {noise.gyro / period_s, 2.0 * noise.gyro_walk, 2.0 * sigma * sigma};
}

std::vector<models::Pose> FramesInI(const models::Suite& suite, SensorId imu,
                                    std::optional<SensorId> wheels) {
  std::vector<models::Pose> frames;
  for (const models::MountedSensor& sensor : suite.sensors) frames.push_back(sensor.X_BS);
  if (wheels) frames[*wheels] = suite.wheels->X_BS;
  for (models::Pose& X : frames) X.p -= suite.sensors[imu].X_BS.p;
  return frames;
}

}  // namespace

FilterBeliefs::FilterBeliefs(const Setup& told)
    : setup(Checked(told)),
      gate(told.gate),
      noise(Squared(told)),
      gravity(0, 0, -told.gravity_m_s2),
      imu(PrimaryImu(told.suite)),
      period_ns(told.suite.sensors[imu].period_ns),
      R_BS_imu(told.suite.sensors[imu].X_BS.R),
      p_BI(told.suite.sensors[imu].X_BS.p) {
  stage_noise = StageNoise(told.gyro_filter, noise, models::Seconds(period_ns));
  const models::Suite& suite = told.suite;
  if (suite.wheels) wheels = suite.Find(suite.wheels->encoders);
  if (suite.legs) {
    leg_encoders = suite.Find(suite.legs->encoders);
    const bool told_which = !told.contacts.sensor.empty();
    contacts = suite.Find(told_which ? told.contacts.sensor : suite.legs->contacts);
    if (told.feet == FootKind::kRolling) rolling_radius_m = suite.legs->foot_radius_m;
  }
  if (!told.gyro_filter.source.empty()) gyro_source = suite.Find(told.gyro_filter.source);
  if (gyro_source == imu) {
    throw std::invalid_argument("the gyro filter's source `" + told.gyro_filter.source +
                                "` is the IMU that it refines");
  }
  gyro_source_is_imu = gyro_source && gyro_source != wheels;
  slip_limit = ChiSquareQuantile(3, told.slip.probability);
  X_IS = FramesInI(suite, imu, wheels);
}

Refusal FilterBeliefs::WhyNotOfFeet(const models::FootVector& feet) const {
  const auto legs = static_cast<Eigen::Index>(setup.suite.legs->legs.size());
  return feet.size() == legs ? Refusal::kNone : Refusal::kInvalid;
}

bool FilterBeliefs::HasAllJoints(const models::EncoderVector& joints) const {
  for (const models::LegKinematics& leg : setup.suite.legs->legs) {
    for (const int entry : leg.entries()) {
      if (entry >= joints.size()) return false;
    }
  }
  return true;
}

Refusal FilterBeliefs::WhyUseless(const models::Measurement& m) const {
  const SensorId sensor = m.sensor;
  if (const auto* encoders = std::get_if<models::EncoderSample>(&m.sample)) {
    if (sensor == wheels) {
      return MeanRates(*encoders, *setup.suite.wheels) ? Refusal::kNone : Refusal::kInvalid;
    }
    if (sensor != leg_encoders) return Refusal::kUnused;
    return HasAllJoints(encoders->angle_rad) ? Refusal::kNone : Refusal::kInvalid;
  } else if (const auto* contact = std::get_if<models::ContactSample>(&m.sample)) {
    if (sensor != contacts) return Refusal::kUnused;
    return WhyNotOfFeet(contact->probability);
  } else if (const auto* forces = std::get_if<models::FootForceSample>(&m.sample)) {
    if (sensor != contacts) return Refusal::kUnused;
    return WhyNotOfFeet(forces->force_n);
  } else if (const auto* torques = std::get_if<models::TorqueSample>(&m.sample)) {
    if (sensor != contacts) return Refusal::kUnused;
    return HasAllJoints(torques->torque_n_m) ? Refusal::kNone : Refusal::kInvalid;
  } else if (std::holds_alternative<models::ImuSample>(m.sample)) {
    return sensor == gyro_source ? Refusal::kNone : Refusal::kUnused;
  } else if (std::holds_alternative<models::DepthSample>(m.sample)) {
    return setup.noise.depth_m > 0.0 ? Refusal::kNone : Refusal::kUnused;
  } else if (const auto* velocity = std::get_if<models::BodyVelocitySample>(&m.sample)) {
    const bool useful = velocity->over_ground || setup.noise.water_current_m_per_s > 0.0;
    return useful ? Refusal::kNone : Refusal::kUnused;
  }
  return Refusal::kNone;
}

Eigen::Matrix3d FilterBeliefs::CovarianceOf(const models::BodyVelocitySample& y) const {
  const double scale = setup.noise.body_velocity_scale;
  Eigen::Matrix3d covariance = scale * scale * y.covariance;
  if (y.over_ground) return covariance;
  covariance.diagonal().array() += std::pow(setup.noise.water_current_m_per_s, 2);
  return covariance;
}

double FilterBeliefs::SamplesOfOneTilt(models::SensorId sensor) const {
  constexpr double kCorrelationTime = 10.0;  // s
  const double period_s = models::Seconds(setup.suite.sensors[sensor].period_ns);
  return period_s > 0.0 ? std::max(1.0, 2.0 * kCorrelationTime / period_s) : 1.0;
}

int FilterBeliefs::MostCorrections(const models::Measurement& m) const {
  if (m.sensor == contacts) return 0;
  if (std::holds_alternative<models::PoseSample>(m.sample)) return 2;  // position, yaw
  const int floor = setup.floor.use ? 1 : 0;
  if (m.sensor == leg_encoders) {
    return static_cast<int>(setup.suite.legs->legs.size());  // a contact, or the floor of a new one
  }
  if (m.sensor == wheels) return 1 + floor + (m.sensor == gyro_source ? 1 : 0);
  return 1;
}

}  // namespace reckon::estimator
