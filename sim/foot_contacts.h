#pragma once

#include <array>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "reckon/ground_truth/truth.h"
#include "reckon/sim/terrain.h"

namespace reckon::sim {

/// The feet of a robot in MuJoCo: a sphere each, and what they do to the ground.
class FootContacts {
 public:
  /// `feet` are links of `model`, each with the geom `FootGeom(link)`.
  FootContacts(const mjModel& model, const std::vector<std::string>& feet);

  static std::string FootGeom(const std::string& foot) { return foot + "/sphere"; }

  /// Gives each foot the friction of the ground under it.
  void SetFriction(const Terrain& terrain, const mjData& data, mjModel& model) const;

  /// After a step: forces, slip and speeds at the state before it, to which MuJoCo's contacts and
  /// body velocities belong. A foot that touches in several points has the sum of their forces and
  /// the mean of their slip, weighed by the normal forces. Does not allocate.
  ground_truth::FeetTruth Read(const mjModel& model, const mjData& data) const;

  /// Whether the robot's trunk touches the ground; its limbs may.
  static bool TrunkTouches(const mjModel& model, const mjData& data);

 private:
  int count_;
  std::array<int, models::kMaxFeet> geom_{};
};

}  // namespace reckon::sim
