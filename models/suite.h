#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "reckon/models/leg_dynamics.h"
#include "reckon/models/leg_kinematics.h"
#include "reckon/models/measurement.h"
#include "reckon/models/pose.h"

namespace reckon::models {

/// What a sensor sends: the alternatives of `Sample`, by name and in the same order.
enum class SensorKind : std::uint8_t {
  kImu,
  kEncoders,
  kBodyVelocity,
  kDepth,
  kPose,
  kContacts,
  kTorques,
  kFootForces,
};

/// How many kinds there are.
inline constexpr std::size_t kSensorKinds = std::variant_size_v<Sample>;

/// The most channels that a sample of this kind can have: one for each joint, wheel or foot; 0 for
/// kinds whose samples always have the same numbers.
constexpr int MostChannels(SensorKind kind) {
  switch (kind) {
    case SensorKind::kEncoders:
    case SensorKind::kTorques:
      return kMaxEncoders;
    case SensorKind::kContacts:
    case SensorKind::kFootForces:
      return kMaxFeet;
    default:
      return 0;
  }
}

/// How many channels this sample has, of a kind that has channels; 0 for other kinds.
int Channels(const Sample& sample);

/// A sensor as the estimator believes it to be: what it is and where it sits on the nominal robot.
struct MountedSensor {
  std::string name;
  SensorKind kind = SensorKind::kImu;
  Pose X_BS;  ///< the sensor's frame in the body: rotation and lever arm, never assumed zero
  TimeNs period_ns = 0;  ///< nominal time between two samples
};

/// The believed drive of a skid-steered or differential robot.
///
/// The forward speed is `rolling_radius_m` times the mean wheel rate. It and the nonholonomic
/// conditions v_y = v_z = 0 hold in the frame `X_BS`, whose origin is the centre of rotation that a
/// calibration finds, not necessarily the body's.
struct WheelDrive {
  std::string encoders;          ///< the sensor that reports the wheels
  std::vector<int> left, right;  ///< entries of its sample, by side
  double rolling_radius_m = 0.0;
  double effective_track_m = 0.0;  ///< (v_right − v_left) / yaw rate, slip included
  Pose X_BS;
};

/// The believed legs of a walking robot; entry i of a contact sample speaks of leg i.
struct LegSet {
  std::string encoders;                    ///< the sensor that reports the joints
  std::string contacts;                    ///< the sensor that says which feet stand
  std::vector<LegKinematics> legs;         ///< at most kMaxFeet
  double foot_radius_m = 0.0;              ///< of the sphere around a foot's origin
  std::vector<LegDynamics> dynamics = {};  ///< likewise; empty if the masses are not known
};

/// The nominal robot's sensors: a measurement's `sensor` is an index into `sensors`.
struct Suite {
  std::vector<MountedSensor> sensors;
  std::optional<WheelDrive> wheels;
  std::optional<LegSet> legs;

  /// The id of the sensor called `name`; nothing if there is none.
  std::optional<SensorId> Find(const std::string& name) const;
};

}  // namespace reckon::models
