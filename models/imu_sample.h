#pragma once

#include <Eigen/Core>

#include "reckon/models/time.h"

namespace reckon::models {

/// One sample of an inertial measurement unit, in its own frame S.
///
/// The sample covers the interval (t − interval, t], where t is the measurement's time of validity:
/// it propagates a state from the interval's start to its end. With Δθ = Log(R_S,iᵀ R_S,j) and
/// Δv = R_S,iᵀ (v_S,j − v_S,i − g Δt), a perfect unit in `increment` mode reports
///     gyro  = Δθ / Δt,
///     accel = Γ1(Δθ)⁻¹ Δv / Δt,
/// so that the recursion R Γ0(ωΔt), v + R Γ1(ωΔt) a Δt + g Δt reproduces R and v exactly.
struct ImuSample {
  Eigen::Vector3d gyro_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_m_s2 = Eigen::Vector3d::Zero();  ///< specific force: +9.81 along up at rest
  TimeNs interval_ns = 0;
  bool gyro_saturated = false;   ///< at least one axis was clipped at the range's end
  bool accel_saturated = false;  ///< likewise
};

}  // namespace reckon::models
