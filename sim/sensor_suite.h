#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/models/measurement.h"
#include "reckon/models/pose.h"
#include "reckon/sim/environment.h"
#include "reckon/sim/faults.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

class Imu;

/// One sensor of the simulated robot: what it is called in draws and faults, which id its messages
/// carry, and where it really sits.
struct SensorSpec {
  std::string name;
  models::SensorId id = 0;
  models::Pose X_BS;
  SensorErrors errors;
};

/// All synthesised sensors of a robot and the faults that act on them.
///
/// Every draw is addressed by seed, sensor name and sample number, so that a sensor's stream
/// depends on nothing but its own configuration and the motion.
class SensorSuite {
 public:
  /// `environment` is that of the motion windows; what it points to must outlive this.
  /// Throws std::invalid_argument with a sentence that names the sensor, the field, what was found
  /// and what is allowed; also for two sensors of one name and a fault on a sensor that isn't
  /// there.
  SensorSuite(std::span<const SensorSpec> sensors, std::span<const FaultConfig> faults,
              std::uint64_t seed, const Environment& environment);
  ~SensorSuite();
  SensorSuite(SensorSuite&&) noexcept;
  SensorSuite& operator=(SensorSuite&&) noexcept;

  /// Called once for each physics step, in order, from t = 0 on. Appends what became complete, in
  /// the order of the sensors; a message's arrival may lie in the future. Allocates only when `out`
  /// must grow.
  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out);

  /// True biases of the first IMU in the axes of I (its origin, the axes of B), R_BS b_S, after the
  /// last call of Observe: those that its next sample will carry. Before the first call: those at
  /// t = 0. Zero if there is no IMU. A fault's bias step is no part of them.
  Eigen::Vector3d gyro_bias() const;
  Eigen::Vector3d accel_bias() const;

 private:
  struct Entry {
    std::unique_ptr<Sensor> sensor;
    FaultInjector faults;
  };

  std::vector<Entry> entries_;
  const Imu* imu_ = nullptr;
  Eigen::Matrix3d R_BS_imu_ = Eigen::Matrix3d::Identity();
};

}  // namespace reckon::sim
