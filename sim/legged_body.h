#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reckon/models/leg_dynamics.h"
#include "reckon/models/leg_kinematics.h"
#include "reckon/models/urdf_robot.h"
#include "reckon/sim/legged_config.h"

namespace reckon::sim {

/// The joints of a robot's legs, leg by leg in the order of `feet`, from the body outwards. Throws
/// std::invalid_argument for a foot that is not there or hangs on no joint, and for two legs that
/// share one.
std::vector<std::string> LegJoints(const models::UrdfRobot& urdf,
                                   const std::vector<std::string>& feet);

/// A robot on legs of three turning joints, as its controller knows it: its own URDF.
class LeggedBody {
 public:
  static constexpr int kLegJoints = 3;
  using Joints = Eigen::Vector3d;  ///< of one leg

  /// Throws std::invalid_argument, which names the thing at fault: no foot or more than kMaxFeet,
  /// legs of other than three turning joints, lists of other than three entries, a motor without
  /// <limit effort>, an upright stance that puts no room under the body.
  LeggedBody(const models::UrdfRobot& urdf, const LeggedConfig& config);

  int legs() const { return static_cast<int>(kinematics_.size()); }
  const models::LegKinematics& kinematics(int leg) const { return kinematics_[leg]; }
  const models::LegDynamics& dynamics(int leg) const { return dynamics_[leg]; }
  const std::vector<std::string>& joints() const { return joints_; }

  /// One leg's entries of a vector of all joints.
  static Joints Of(int leg, const models::EncoderVector& all) {
    return all.segment<kLegJoints>(kLegJoints * leg);
  }

  const models::EncoderVector& stand_angles_rad() const { return stand_angles_rad_; }
  const models::EncoderVector& torque_limit_n_m() const { return torque_limit_n_m_; }
  const Eigen::Vector3d& stand_foot(int leg) const { return stand_foot_[leg]; }  ///< p_BF

  /// Of the trunk's origin over the ground that it stands on.
  double stand_height_m() const { return stand_height_m_; }
  double foot_radius_m() const { return foot_radius_m_; }

  // Of the whole robot as it stands, about its centre of mass C.
  double mass_kg() const { return whole_.mass_kg; }
  const Eigen::Vector3d& p_BC() const { return whole_.p_LC; }
  const Eigen::Matrix3d& inertia_kg_m2() const { return whole_.I_C_L; }

 private:
  void WeighStanding(const models::UrdfRobot& urdf);

  std::vector<std::string> joints_;
  std::vector<models::LegKinematics> kinematics_;
  std::vector<models::LegDynamics> dynamics_;
  std::vector<Eigen::Vector3d> stand_foot_;
  models::EncoderVector stand_angles_rad_, torque_limit_n_m_;
  double stand_height_m_ = 0.0, foot_radius_m_ = 0.0;
  models::UrdfInertial whole_;
};

}  // namespace reckon::sim
