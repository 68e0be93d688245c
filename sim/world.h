#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "reckon/ground_truth/truth.h"
#include "reckon/sim/environment.h"
#include "reckon/sim/motion_window.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/world_config.h"

struct mjModel_;
struct mjData_;

namespace reckon::sim {

/// The run can't go on: the robot left the map, turned over, or the physics raised a warning.
/// The message names what happened, where and when.
class WorldFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The robot in its world, stepped by MuJoCo. No global state: several worlds may live in one
/// process, on threads of their own. The same arguments give the same bytes.
class World {
 public:
  /// Builds the world and lets the robot come to rest, so that t = 0 is a still robot.
  /// Throws std::invalid_argument for a robot or terrain that can't be built.
  World(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Moves `motion` to the next instant; the first call gives t = 0. Throws WorldFailure.
  void Advance();

  const MotionWindow& motion() const;

  /// What sensors may know of it. What it points to lives as long as the world.
  Environment environment() const;

  /// What really happens at `motion().t_ns`, with zero IMU biases (the caller knows the sensors).
  ground_truth::Truth TruthNow() const;

  /// The physics itself, for pictures: its state is that of the next instant.
  const mjModel_& physics_model() const;
  const mjData_& physics_data() const;

  /// Name and version of the physics engine.
  static std::string PhysicsVersion();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reckon::sim
