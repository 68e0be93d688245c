#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::models {

/// The most moving joints that one leg can have.
inline constexpr int kMaxLegJoints = 8;

/// Where a foot is, and how its joints move it.
struct FootPosition {
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxLegJoints>;
  Eigen::Vector3d p_BF = Eigen::Vector3d::Zero();  ///< the foot's origin in the body [m]
  Jacobian J;  ///< ∂p_BF/∂q of the leg's moving joints, in order
};

/// The serial chain of joints from the body to a foot, as the URDF has it.
class LegKinematics {
 public:
  /// `foot` is a link; `encoders` names the joint that each entry of an encoder sample reads.
  /// Throws std::invalid_argument if there is no such link, it hangs on no moving joint or on more
  /// than kMaxLegJoints, or a joint of the chain has no encoder.
  LegKinematics(const UrdfRobot& robot, const std::string& foot,
                std::span<const std::string> encoders);

  const std::string& foot() const { return foot_; }

  /// The entry of an encoder sample that reads each moving joint, from the body outwards.
  std::span<const int> entries() const { return entries_; }

  /// The foot at these joint angles [rad, m], indexed by entry: all of `entries()` must be there.
  /// With z_k the axis and p_k the origin of joint k in the body,
  ///     ∂p_BF/∂q_k = z_k × (p_BF − p_k) for a turning joint and z_k for a sliding one.
  /// Does not allocate.
  FootPosition Evaluate(const EncoderVector& angles) const;

 private:
  struct Link {
    Pose X_PJ;  ///< from the parent link to the joint at zero
    Eigen::Vector3d axis;
    bool turns;
    int entry;
  };

  std::string foot_;
  std::vector<Link> chain_;
  Pose X_last_F_;  ///< what is fixed behind the last joint
  std::vector<int> entries_;
};

}  // namespace reckon::models
