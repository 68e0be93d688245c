#include "reckon/sim/sensor_suite.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <variant>

#include "reckon/sim/body_velocity_sensor.h"
#include "reckon/sim/contact_sensor.h"
#include "reckon/sim/depth_sensor.h"
#include "reckon/sim/dvl.h"
#include "reckon/sim/encoders.h"
#include "reckon/sim/imu.h"
#include "reckon/sim/load_sensors.h"
#include "reckon/sim/pose_sensor.h"

namespace reckon::sim {
namespace {

/// Builds the sensor that a description stands for.
struct Maker {
  const SensorSpec& spec;
  std::uint64_t seed;
  const Environment& environment;

  std::unique_ptr<Sensor> operator()(const ImuConfig& config) const {
    return std::make_unique<Imu>(spec.name, spec.id, spec.X_BS, config, seed, environment.step_ns,
                                 environment.gravity_m_s2);
  }
  std::unique_ptr<Sensor> operator()(const EncoderConfig& config) const {
    return std::make_unique<Encoders>(spec.name, spec.id, config, seed, environment.step_ns);
  }
  std::unique_ptr<Sensor> operator()(const BodyVelocityConfig& config) const {
    return std::make_unique<BodyVelocitySensor>(spec.name, spec.id, spec.X_BS, config, seed,
                                                environment.step_ns);
  }
  std::unique_ptr<Sensor> operator()(const DepthConfig& config) const {
    return std::make_unique<DepthSensor>(spec.name, spec.id, spec.X_BS, config, seed, environment);
  }
  std::unique_ptr<Sensor> operator()(const PoseConfig& config) const {
    return std::make_unique<PoseSensor>(spec.name, spec.id, spec.X_BS, config, seed,
                                        environment.step_ns);
  }
  std::unique_ptr<Sensor> operator()(const DvlConfig& config) const {
    return std::make_unique<Dvl>(spec.name, spec.id, spec.X_BS, config, seed, environment);
  }
  std::unique_ptr<Sensor> operator()(const ContactSensorConfig& config) const {
    return std::make_unique<ContactSensor>(spec.name, spec.id, config, environment.step_ns);
  }
  std::unique_ptr<Sensor> operator()(const TorqueConfig& config) const {
    return std::make_unique<TorqueSensor>(spec.name, spec.id, config, seed, environment.step_ns);
  }
  std::unique_ptr<Sensor> operator()(const FootForceConfig& config) const {
    return std::make_unique<FootForceSensor>(spec.name, spec.id, config, seed, environment.step_ns);
  }
};

void CheckNames(std::span<const SensorSpec> sensors, std::span<const FaultConfig> faults) {
  std::set<std::string> names;
  for (const SensorSpec& spec : sensors) {
    if (names.insert(spec.name).second) continue;
    throw std::invalid_argument("two sensors are called '" + spec.name + "'");
  }
  for (const FaultConfig& fault : faults) {
    if (names.count(fault.sensor) == 1) continue;
    throw std::invalid_argument("a fault names the sensor '" + fault.sensor +
                                "', which the robot does not have");
  }
}

void CheckChannels(std::span<const SensorSpec> sensors, std::span<const FaultConfig> faults) {
  for (const FaultConfig& fault : faults) {
    for (const SensorSpec& spec : sensors) {
      if (spec.name != fault.sensor || HasChannels(spec.errors, fault.channels)) continue;
      throw std::invalid_argument("a fault strikes the channels '" +
                                  std::string(FaultChannelsName(fault.channels)) + "' of '" +
                                  fault.sensor + "', which that sensor does not have");
    }
  }
}

}  // namespace

SensorSuite::SensorSuite(std::span<const SensorSpec> sensors, std::span<const FaultConfig> faults,
                         std::uint64_t seed, const Environment& environment) {
  CheckNames(sensors, faults);
  CheckChannels(sensors, faults);
  if (environment.step_ns < 1 || environment.step_ns > 1'000'000'000) {
    throw std::invalid_argument("the physics step must be 1 ns to 1 s long");
  }
  for (const SensorSpec& spec : sensors) {
    auto sensor = std::visit(Maker{spec, seed, environment}, spec.errors);
    if (const auto* imu = dynamic_cast<const Imu*>(sensor.get()); imu != nullptr && !imu_) {
      imu_ = imu;
      R_BS_imu_ = spec.X_BS.R;
    }
    entries_.push_back({std::move(sensor), FaultInjector(spec.name, faults, seed)});
  }
}

SensorSuite::~SensorSuite() = default;
SensorSuite::SensorSuite(SensorSuite&&) noexcept = default;
SensorSuite& SensorSuite::operator=(SensorSuite&&) noexcept = default;

void SensorSuite::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  for (Entry& entry : entries_) {
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    entry.sensor->Observe(motion, out);
    const auto lost = [&](models::Measurement& message) { return !entry.faults.Apply(message); };
    out.erase(std::remove_if(out.begin() + begin, out.end(), lost), out.end());
  }
}

Eigen::Vector3d SensorSuite::gyro_bias() const {
  if (imu_ == nullptr) return Eigen::Vector3d::Zero();
  return R_BS_imu_ * imu_->gyro_bias();
}

Eigen::Vector3d SensorSuite::accel_bias() const {
  if (imu_ == nullptr) return Eigen::Vector3d::Zero();
  return R_BS_imu_ * imu_->accel_bias();
}

}  // namespace reckon::sim
