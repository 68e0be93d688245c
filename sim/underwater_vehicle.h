#pragma once

#include <cstdint>

#include "reckon/sim/autopilot.h"
#include "reckon/sim/current.h"
#include "reckon/sim/hydrodynamics.h"
#include "reckon/sim/navigator.h"
#include "reckon/sim/scenery.h"
#include "reckon/sim/submerged_body.h"
#include "reckon/sim/thrusters.h"
#include "reckon/sim/vehicle.h"

namespace reckon::sim {

/// An underwater vehicle in the sea, flying the scenario's mission: one body with the collision
/// shapes of its URDF, which can touch and rest on the bottom.
class UnderwaterVehicle : public Vehicle {
 public:
  /// Places it where its mission starts, level, with its bow along x. Throws std::invalid_argument
  /// for a robot, water, seabed or mission that can't be, such as a mission that leads above the
  /// surface or under the seabed.
  UnderwaterVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed);

  VehicleState Read() override;
  void Step(models::TimeNs t_ns, VehicleState& now) override;
  bool IsSettled() const override { return true; }  // it hovers
  std::optional<std::string> Trouble(const VehicleState& state) const override;
  const Surroundings* surroundings() const override { return &scenery_; }

 private:
  UnderwaterVehicle(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed,
                    Seabed seabed);
  void CheckMission() const;

  Seabed seabed_;
  SubmergedBody body_;
  Hydrodynamics hydrodynamics_;
  Thrusters thrusters_;
  Current current_;
  Autopilot autopilot_;
  Navigator navigator_;
  Scenery scenery_;
  double step_s_;
  double top_m_;  ///< of the hull over the origin of B, when it is level
  long long control_period_steps_, steps_ = 0;
  Vector6 wanted_ = Vector6::Zero();
};

}  // namespace reckon::sim
