#pragma once

#include <cstdint>

#include <mujoco/mujoco.h>

#include "reckon/sim/terrain.h"

namespace reckon::sim {

/// Adds the ground that feet stand on to a world. Slopes and rough ground are the terrain's; stairs
/// and debris stand on a plane; gravel is a fine heightfield. `seed` places what is random.
/// Rectangles of other friction are drawn on flat ground.
void AddWalkingGround(const Terrain& terrain, const std::vector<PatchConfig>& patches,
                      std::uint64_t seed, mjSpec* spec, mjsBody* world);

/// Gives a geom of the ground or of a foot the terrain's contact. Where two meet, the one of higher
/// `priority` says friction and softness: MuJoCo would else take the larger friction.
void SetGroundContact(const TerrainConfig& terrain, int priority, mjsGeom* geom);

/// The highest that the ground can lie over the terrain's own height at a point [m].
double HighestOverTerrain(const TerrainConfig& terrain);

}  // namespace reckon::sim
