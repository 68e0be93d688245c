#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/driver.h"
#include "reckon/sim/foot_contacts.h"
#include "reckon/sim/free_joint.h"
#include "reckon/sim/legged_body.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/terrain.h"
#include "reckon/sim/vehicle.h"
#include "reckon/sim/walking_controller.h"

namespace reckon::sim {

/// A robot on legs, walking along the scenario's motion.
class LeggedVehicle : public Vehicle {
 public:
  /// Stands the robot over the ground at x = y = 0 with yaw 0; it settles on its feet. Throws
  /// std::invalid_argument for a robot, terrain or gait that can't be built.
  LeggedVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed);

  VehicleState Read() override;
  void Step(models::TimeNs t_ns, VehicleState& now) override;
  bool IsSettled() const override;
  std::optional<std::string> Trouble(const VehicleState& state) const override;

 private:
  LeggedVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed,
                Terrain terrain, const models::UrdfRobot& urdf, LeggedBody body);
  LeggedVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed,
                const models::UrdfRobot& urdf);

  ControlState TrueState(const VehicleState& now) const;
  void Control(models::TimeNs t_ns, const VehicleState& now);
  void Push(models::TimeNs t_ns);
  void Hang();

  WorldConfig config_;
  Terrain terrain_;
  LeggedBody body_;
  WalkingController controller_;
  Driver driver_;
  FreeJoint base_;
  FootContacts contacts_;
  RandomStream push_draws_;
  std::vector<int> joint_angle_address_, joint_rate_address_;
  int base_body_ = 0;
  models::Pose start_;
  models::TimeNs control_period_ns_, driver_period_ns_;
  long long steps_ = 0;
  WalkCommand command_;
  models::EncoderVector wanted_n_m_, torque_n_m_;
  ground_truth::FeetTruth feet_;  ///< of the step before
};

}  // namespace reckon::sim
