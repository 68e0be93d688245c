#include "reckon/sim/sensor_suite.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "reckon/sim/body_velocity_sensor.h"
#include "reckon/sim/depth_sensor.h"
#include "reckon/sim/encoders.h"
#include "reckon/sim/imu.h"
#include "reckon/sim/pose_sensor.h"

namespace reckon::sim {
namespace {

models::TimeNs StepNs(double physics_step_s) {
  const double ns = physics_step_s * 1e9;
  if (!(ns >= 1.0) || ns > 1e9 || std::abs(ns - std::round(ns)) > 1e-5) {
    std::ostringstream text;
    text << "the physics step is " << physics_step_s
         << " s, expected a whole number of nanoseconds, at most 1 s";
    throw std::invalid_argument(text.str());
  }
  return std::llround(ns);
}

/// Builds the sensor that a description stands for.
struct Maker {
  const SensorSpec& spec;
  std::uint64_t seed;
  models::TimeNs step_ns;
  double gravity_m_s2;

  std::unique_ptr<Sensor> operator()(const ImuConfig& config) const {
    return std::make_unique<Imu>(spec.name, spec.id, spec.X_BS, config, seed, step_ns,
                                 gravity_m_s2);
  }
  std::unique_ptr<Sensor> operator()(const EncoderConfig& config) const {
    return std::make_unique<Encoders>(spec.name, spec.id, config, seed, step_ns);
  }
  std::unique_ptr<Sensor> operator()(const BodyVelocityConfig& config) const {
    return std::make_unique<BodyVelocitySensor>(spec.name, spec.id, spec.X_BS, config, seed,
                                                step_ns);
  }
  std::unique_ptr<Sensor> operator()(const DepthConfig& config) const {
    return std::make_unique<DepthSensor>(spec.name, spec.id, spec.X_BS, config, seed, step_ns);
  }
  std::unique_ptr<Sensor> operator()(const PoseConfig& config) const {
    return std::make_unique<PoseSensor>(spec.name, spec.id, spec.X_BS, config, seed, step_ns);
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
                         std::uint64_t seed, double physics_step_s, double gravity_m_s2) {
  CheckNames(sensors, faults);
  CheckChannels(sensors, faults);
  const models::TimeNs step_ns = StepNs(physics_step_s);
  for (const SensorSpec& spec : sensors) {
    auto sensor = std::visit(Maker{spec, seed, step_ns, gravity_m_s2}, spec.errors);
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
