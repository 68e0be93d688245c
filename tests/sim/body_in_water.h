#pragma once

#include <Eigen/Core>

#include "reckon/sim/hydrodynamics.h"

namespace reckon::testing_sim {

using sim::HydrodynamicsConfig;
using sim::Matrix6;
using sim::Vector6;
using sim::WaterMotion;

/// A rigid body in water: its mass, its inertia about its centre of mass, and what the water does.
struct BodyInWater {
  double mass_kg = 13.5;
  Eigen::Vector3d p_BG_m{0, 0, 1e-6};  ///< centre of mass
  Eigen::Vector3d inertia_kg_m2{0.26, 0.23, 0.37};
  HydrodynamicsConfig water;
  double density_kg_m3 = 1025.0;
};

constexpr double kG = 9.81;

/// A heavy small ROV: von Benzon et al., J. Mar. Sci. Eng. 2022, 10, 1898.
inline BodyInWater Rov() {
  BodyInWater rov;
  rov.water.volume_m3 = 0.0134;
  rov.water.p_BV_m = {0, 0, 0.01};
  Vector6 added;
  added << 6.36, 7.12, 18.68, 0.189, 0.135, 0.222;
  rov.water.added_mass = added.asDiagonal();
  rov.water.linear_damping << 13.7, 0, 33, 0, 0.8, 0;
  rov.water.quadratic_damping << 141, 217, 190, 1.19, 0.47, 1.5;
  return rov;
}

/// It floats where it is: as heavy as the water it displaces.
inline BodyInWater Neutral(BodyInWater body) {
  body.density_kg_m3 = body.mass_kg / body.water.volume_m3;
  return body;
}

}  // namespace reckon::testing_sim
