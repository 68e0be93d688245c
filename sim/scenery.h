#pragma once

#include <mujoco/mujoco.h>

#include "reckon/sim/seabed.h"
#include "reckon/sim/surroundings.h"

namespace reckon::sim {

/// The geom groups: what a ray can meet, what is seen of the robot, and what it touches with (not
/// drawn).
inline constexpr int kSceneryGroup = 0, kRobotGroup = 1, kHullGroup = 3;

/// Contact of hard things: the geoms of scenery and robot meet with this friction.
void SetHardContact(mjsGeom* geom, double friction);

/// Adds the bottom of the sea to a world as geoms that a vehicle touches: a plane, or a heightfield
/// with nodes a quarter of the shortest wave apart (on large maps more: 2000 a side at most), and a
/// box, an ellipsoid or a cylinder a feature.
void AddSeabed(const Seabed& seabed, mjSpec* spec, mjsBody* world);

/// The geoms of kSceneryGroup, which do not move, seen along rays.
class Scenery : public Surroundings {
 public:
  /// Both must live as long as this, and `data` have its kinematics.
  Scenery(const mjModel& model, const mjData& data) : model_(&model), data_(&data) {}

  std::optional<RayHit> Cast(const Eigen::Vector3d& from,
                             const Eigen::Vector3d& direction) const override;

 private:
  const mjModel* model_;
  const mjData* data_;
};

}  // namespace reckon::sim
