#pragma once

#include <cstdint>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/driver.h"
#include "reckon/sim/skid_steer.h"
#include "reckon/sim/terrain.h"
#include "reckon/sim/vehicle.h"

namespace reckon::sim {

/// A skid-steer on its terrain, driven along the scenario's motion.
class SkidSteerVehicle : public Vehicle {
 public:
  /// Places the robot on the ground at x = y = 0 with yaw 0, its wheels as deep in the ground as
  /// they will rest. Throws std::invalid_argument for a robot or terrain that can't be built.
  SkidSteerVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed);

  VehicleState Read() override;
  void Step(models::TimeNs t_ns, VehicleState& now) override;
  bool IsSettled() const override;
  void Release() override { steer_.SetBrake(false); }
  std::optional<std::string> Trouble(const VehicleState& state) const override;

 private:
  SkidSteerVehicle(const RobotConfig& robot, const WorldConfig& config, Terrain terrain,
                   const models::UrdfRobot& urdf);

  Terrain terrain_;
  Driver driver_;
  SkidSteer steer_;
  DriveCommand command_;
  models::TimeNs driver_period_ns_;
};

}  // namespace reckon::sim
