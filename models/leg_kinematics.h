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

/// One entry for each moving joint of a leg, from the body outwards.
using LegVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLegJoints, 1>;

/// Where a foot is, and how its joints move it.
struct FootPosition {
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxLegJoints>;
  Eigen::Vector3d p_BF = Eigen::Vector3d::Zero();  ///< the foot's origin in the body [m]
  Jacobian J;  ///< ∂p_BF/∂q of the leg's moving joints, in order
  Jacobian A;  ///< the foot's link turns by A q̇ against the body, in B: zero for sliding joints
};

/// The joints (indices) from the body to `link`, in that order, fixed ones too.
std::vector<int> JointsTo(const UrdfRobot& robot, int link);

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
  ///     ∂p_BF/∂q_k = z_k × (p_BF − p_k) for a turning joint and z_k for a sliding one,
  /// and A's columns are z_k and 0.
  /// Does not allocate.
  FootPosition Evaluate(const EncoderVector& angles) const;

  /// The leg's own joints out of a whole robot's vector, in the order of `entries()`. Does not
  /// allocate.
  LegVector Pick(const EncoderVector& all) const {
    LegVector own(static_cast<Eigen::Index>(entries_.size()));
    for (std::size_t k = 0; k < entries_.size(); ++k) own[k] = all[entries_[k]];
    return own;
  }

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
