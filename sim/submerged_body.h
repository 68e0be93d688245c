#pragma once

#include <mujoco/mujoco.h>

#include "reckon/sim/free_joint.h"
#include "reckon/sim/hydrodynamics.h"

namespace reckon::sim {

/// A body on a free joint of MuJoCo that moves in water. Its added mass goes into the mass matrix
/// between the two halves of a step, so that contacts, weight and thrust meet the true inertia; as
/// an explicit force −M_A ν̇ it diverges once it exceeds the body's own. It needs a solver that
/// reads the mass matrix in the second half: Newton or CG.
class SubmergedBody {
 public:
  /// `body` is a body of `model` with a free joint and nothing below it. Throws
  /// std::invalid_argument if its six degrees of freedom are not stored as a full block (MuJoCo
  /// stores them diagonally where the centre of mass is the frame's origin), or the solver is PGS.
  SubmergedBody(const mjModel& model, int body);

  /// Pose of B in W, and ν = (v, ω) of its origin in its axes, of the positions and velocities of
  /// `data`.
  models::Pose Pose(const mjData& data) const { return joint_.Pose(data); }
  void Place(const models::Pose& X_WB, mjData& data) const { joint_.Place(X_WB, data); }
  Vector6 Twist(const mjData& data) const;

  /// Between mj_step1 and mj_step2: M ← M + T M_A Tᵀ with T = blkdiag(R, I), factored anew, and
  /// qfrc_applied = T (wrench + M_A [ω × v; 0]) for the `wrench` of water and thrusters about the
  /// origin of B in its axes. (MuJoCo's linear acceleration is in W, so that ν̇ holds −ω × v beside
  /// it.) Does not allocate.
  void Apply(const Matrix6& added_mass, const Vector6& wrench, const mjModel& model,
             mjData& data) const;

 private:
  FreeJoint joint_;
};

}  // namespace reckon::sim
