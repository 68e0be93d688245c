#pragma once

#include <functional>
#include <string>

#include <mujoco/mujoco.h>

#include "reckon/sim/terrain_table.h"

namespace reckon::sim {

/// A plane through (0, 0, z) that rises as `ground` says, drawn with the material of this name.
mjsGeom* AddGroundPlane(mjsBody* world, const Ground& ground, double z,
                        const std::string& material);

/// Heights over the square |x|, |y| ≤ half_size.
struct HeightSamples {
  double half_size_m = 1.0;
  double spacing_m = 0.1;                        ///< wanted; no side has more than 2000 nodes
  std::function<double(double, double)> height;  ///< at (x, y) [m]
};

/// A heightfield called `name`, its heights from `z` on, drawn likewise.
mjsGeom* AddHeightfield(mjSpec* spec, mjsBody* world, const std::string& name,
                        const HeightSamples& samples, double z, const std::string& material);

/// A material of squares of two colours (RGB), `square_m` wide.
void AddChecker(mjSpec* spec, const std::string& name, const double (&light)[3],
                const double (&dark)[3], double square_m);

/// A sky that fades from one colour to the other at eye level.
void AddSky(mjSpec* spec, const std::string& name, const double (&above)[3],
            const double (&level)[3]);

void SetPosition(mjsGeom* geom, double x, double y, double z);

}  // namespace reckon::sim
