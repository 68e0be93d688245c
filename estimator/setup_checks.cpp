#include "reckon/estimator/setup_checks.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::estimator {
namespace {

void Require(bool condition, const std::string& sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

void CheckSide(const std::vector<int>& entries, const std::string& side) {
  Require(!entries.empty(), "the drive has no " + side + " wheel");
  for (const int entry : entries) {
    Require(entry >= 0 && entry < models::kMaxEncoders,
            "the drive's " + side + " wheel " + std::to_string(entry) + " is no encoder's entry");
  }
}

bool Has(const models::Suite& suite, const std::string& sensor, models::SensorKind kind) {
  const auto id = suite.Find(sensor);
  return id && suite.sensors[*id].kind == kind;
}

bool NotNegative(double x) { return std::isfinite(x) && x >= 0.0; }

void CheckContacts(const Setup& setup) {
  using Kind = models::SensorKind;
  const models::Suite& suite = setup.suite;
  const ContactDetection& told = setup.contacts;
  const std::string& name = told.sensor.empty() ? suite.legs->contacts : told.sensor;
  const bool torques = Has(suite, name, Kind::kTorques);
  Require(torques || Has(suite, name, Kind::kFootForces) || Has(suite, name, Kind::kContacts),
          "the legs' contacts `" + name + "` are no contact, torque or foot force sensor");
  Require(!torques || suite.legs->dynamics.size() == suite.legs->legs.size(),
          "contacts from torques need the legs' masses");
  Require(std::isfinite(told.observer_hz) && told.observer_hz > 0.0,
          "the contacts' observer_hz must be positive");
  Require(NotNegative(told.cutoff_hz) && NotNegative(told.logistic_n) &&
              NotNegative(told.hysteresis_n) && NotNegative(told.threshold_n),
          "the contacts' numbers must not be negative");
}

void CheckLegs(const Setup& setup) {
  const models::Suite& suite = setup.suite;
  const models::LegSet& legs = *suite.legs;
  Require(!legs.legs.empty() && legs.legs.size() <= models::kMaxFeet,
          "a robot has 1 to " + std::to_string(models::kMaxFeet) + " legs");
  Require(Has(suite, legs.encoders, models::SensorKind::kEncoders),
          "the legs' encoders `" + legs.encoders + "` are no encoders of the suite");
  CheckContacts(setup);
  const bool velocity = setup.leg_correction == LegCorrection::kVelocity;
  Require(velocity || setup.noise.joint_angle_rad > 0.0 || setup.noise.foot_position_m > 0.0,
          "legs need a positive joint_angle_rad or foot_position_m");
  Require(
      (!velocity && setup.slip.rule != SlipRule::kNis) || setup.noise.leg_velocity_m_per_s > 0.0,
      "legs used as a velocity, and the slip rule nis, need a positive leg_velocity_m_per_s");
  const SlipRejection& slip = setup.slip;
  Require(slip.rule == SlipRule::kOff || !velocity, "a slip rule is for feet in the state");
  Require(std::isfinite(slip.speed_m_s) && slip.speed_m_s > 0.0,
          "the slip rule's speed_m_s must be positive");
  Require(std::isfinite(slip.factor) && slip.factor >= 1.0,
          "the slip rule's factor must be at least 1");
  Require(std::isfinite(slip.correlation_s) && slip.correlation_s > 0.0,
          "the slip rule's correlation_s must be positive");
  Require(slip.probability > 0.5 && slip.probability < 1.0,
          "the slip rule's probability must lie between 0.5 and 1");
}

void CheckGyroSource(const Setup& setup) {
  const models::Suite& suite = setup.suite;
  const std::string& source = setup.gyro_filter.source;
  const bool wheels = suite.wheels && suite.wheels->encoders == source;
  Require(wheels || Has(suite, source, models::SensorKind::kImu),
          "the gyro filter's source `" + source + "` is neither an IMU nor the wheels' encoders");
  const double sigma = setup.gyro_filter.bias_sigma_rad_s;
  Require(std::isfinite(sigma) && sigma >= 0.0, "bias_sigma_rad_s must not be negative");
  Require(!wheels || setup.noise.wheel_yaw_rate_rad_per_s > 0.0,
          "a gyro filter with wheels needs a positive wheel_yaw_rate_rad_per_s");
  Require(!wheels || suite.wheels->effective_track_m > 0.0,
          "a gyro filter with wheels needs a positive effective track");
}

}  // namespace

void CheckSetup(const Setup& setup) {
  for (const NoiseField& field : NoiseFields()) {
    const double value = setup.noise.*field.member;
    Require(std::isfinite(value) && value >= 0.0,
            std::string(field.name) + " must be finite and not negative");
  }
  Require(std::isfinite(setup.gravity_m_s2) && setup.gravity_m_s2 > 0.0,
          "gravity_m_s2 must be positive");
  const double rest = setup.initialisation.static_duration_s;
  Require(setup.initialisation.kind != InitialisationKind::kStatic ||
              (std::isfinite(rest) && rest > 0.0),
          "static_duration_s must be positive");
  Require(std::isfinite(setup.history_s) && setup.history_s >= 0.0 && setup.history_s <= 60.0,
          "history_s must lie between 0 and 60");
  Require(setup.iterations >= 1, "iterations must be at least 1");
  Require(!setup.standstill.use ||
              (setup.standstill.window_s > 0.0 && setup.noise.standstill_m_per_s > 0.0),
          "standstill needs a positive window_s and a positive standstill_m_per_s");
  Require(
      !setup.floor.use || (std::isfinite(setup.floor.height_m) && setup.noise.floor_height_m > 0.0),
      "floor needs a finite height_m and a positive floor_height_m");
  if (setup.suite.wheels) CheckDrive(setup.suite);
  if (setup.suite.legs) CheckLegs(setup);
  if (!setup.gyro_filter.source.empty()) CheckGyroSource(setup);
}

void CheckDrive(const models::Suite& suite) {
  Require(suite.wheels.has_value(), "this estimator needs wheels, and the suite has none");
  const models::WheelDrive& drive = *suite.wheels;
  CheckSide(drive.left, "left");
  CheckSide(drive.right, "right");
  Require(std::isfinite(drive.rolling_radius_m) && drive.rolling_radius_m > 0.0,
          "rolling_radius_m must be positive");
  const auto id = suite.Find(drive.encoders);
  Require(id && suite.sensors[*id].kind == models::SensorKind::kEncoders,
          "the drive's encoders `" + drive.encoders + "` are no encoders of the suite");
}

void CheckPrior(const Prior& prior) {
  const ErrorCovariance& P = prior.covariance;
  Require(prior.X_WB.R.allFinite() && prior.X_WB.p.allFinite() && prior.v_WB.allFinite() &&
              prior.w_WB_B.allFinite() && prior.gyro_bias_rad_s.allFinite() &&
              prior.accel_bias_m_s2.allFinite() && P.allFinite(),
          "the prior has a number that is not finite");
  Require(prior.X_WB.R.isUnitary(1e-9) && prior.X_WB.R.determinant() > 0.0,
          "the prior's orientation is not a rotation");
  Require(P.diagonal().minCoeff() >= 0.0 &&
              (P - P.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * P.cwiseAbs().maxCoeff(),
          "the prior's covariance is not one");
}

}  // namespace reckon::estimator
