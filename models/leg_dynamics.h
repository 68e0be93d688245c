#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "reckon/models/leg_kinematics.h"

namespace reckon::models {

/// How the body that a leg hangs on moves, in the axes of B: what an IMU in B's origin feels.
struct BodyMotion {
  Eigen::Vector3d w_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d dw_rad_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_m_s2 = Eigen::Vector3d::Zero();  ///< at rest: +9.81 along up
};

/// The rigid-body dynamics of one leg, from the masses in the URDF: links that are fixed to a
/// moving one count as part of it. What the motors add is told apart, as armature.
class LegDynamics {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               kMaxLegJoints, kMaxLegJoints>;

  /// `armature` is the reflected inertia of each joint's motor, from the body outwards [kg m²].
  /// Throws std::invalid_argument for what LegKinematics refuses, and unless `armature` has one
  /// entry a joint.
  LegDynamics(const UrdfRobot& robot, const std::string& foot,
              std::span<const std::string> encoders, std::span<const double> armature);

  /// The torques that give the leg's joints the acceleration `ddq` without a force at the foot
  /// [Featherstone08, recursive Newton-Euler]: τ = M(q) q̈ + h(q, q̇, body). With a force f on the
  /// foot they are less by Jᵀ f. Does not allocate.
  LegVector InverseDynamics(const LegVector& q, const LegVector& dq, const LegVector& ddq,
                            const BodyMotion& body) const;

  /// What holds the leg against gravity, where `up_B` is the unit vector up. Does not allocate.
  LegVector GravityTorque(const LegVector& q, const Eigen::Vector3d& up_B,
                          double gravity_m_s2) const;

  /// M(q), armature included: its columns are torques for unit accelerations. Does not allocate.
  Matrix MassMatrix(const LegVector& q) const;

  int joints() const { return static_cast<int>(chain_.size()); }

 private:
  /// A joint and all that it moves up to the next one, in the axes of its child link.
  struct Link {
    Pose X_PJ;  ///< from the parent's moving link to the joint at zero
    Eigen::Vector3d axis;
    bool turns;
    UrdfInertial mass = {};  ///< in the axes of the child link
    double armature_kg_m2 = 0.0;
  };

  std::vector<Link> chain_;
};

}  // namespace reckon::models
