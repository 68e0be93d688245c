#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/models/urdf_robot.h"
#include "reckon/sim/free_joint.h"
#include "reckon/sim/skid_steer_drive.h"
#include "reckon/sim/skid_steer_model.h"
#include "reckon/sim/tyre.h"

namespace reckon::sim {

/// The running gear of a skid-steer in MuJoCo: motors and tyres, written to `qfrc_applied`. Wheels
/// are ordered left front to rear, then right front to rear.
class SkidSteer {
 public:
  /// Throws std::invalid_argument, which names the key or joint at fault: a side without wheels, a
  /// wheel that is not a continuous joint of the base link, numbers that are not positive.
  static void Check(const RobotConfig& robot, const ActualConfig& actual,
                    const models::UrdfRobot& urdf);

  /// For arguments that pass Check, and the model that was built from them.
  SkidSteer(const RobotConfig& robot, const WorldConfig& config, const models::UrdfRobot& urdf,
            const mjModel& model);

  /// The parking brake, which also damps the tyres: for coming to rest before a run.
  void SetBrake(bool on);

  /// Writes the forces of this instant, which the next mj_step applies. Kerb contacts are those of
  /// the step before. Does not allocate.
  void Apply(const DriveCommand& command, const Terrain& terrain, mjData& data);

  /// Height of the base over flat ground when the tyres carry the robot [m].
  double RestHeight(const mjModel& model) const;

  /// The base's free joint.
  models::Pose BasePose(const mjData& data) const { return base_.Pose(data); }
  void PlaceBase(const models::Pose& X_WB, mjData& data) const { base_.Place(X_WB, data); }

  /// The wheels as `data` had them when they were read last.
  const models::EncoderVector& angle_rad() const { return angle_; }
  const models::EncoderVector& rate_rad_s() const { return rate_; }
  void ReadWheels(const mjData& data);

  /// Of the forces that were written last.
  const models::EncoderVector& slip_m_s() const { return slip_; }
  const models::EncoderVector& load_n() const { return load_; }

 private:
  struct Wheel {
    Eigen::Vector3d p_BW, axis_B;  // centre and axle in the base
    int angle_address = 0, rate_address = 0, geom = -1;
    TyreParameters tyre;
    Tyre state;
  };

  void AddWheel(const RobotConfig& robot, const WorldConfig& config, const models::UrdfRobot& urdf,
                const mjModel& model, const std::string& joint, double radius_scale);
  void ReadKerbContacts(const mjData& data);

  SkidSteerDrive drive_;
  double damping_n_s_m_, dt_s_;
  bool kerbs_;
  FreeJoint base_;
  std::vector<Wheel> wheels_;
  std::vector<WheelContact> kerb_contacts_;
  models::EncoderVector angle_, rate_, slip_, load_;
};

}  // namespace reckon::sim
