#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/prior.h"
#include "reckon/models/suite.h"

namespace reckon::estimator {

/// The noise that a filter believes in: a flat, named vector (see `NoiseFields`).
struct Noise {
  double gyro_noise_density_rad_per_s_sqrt_hz = 0.0;
  double accel_noise_density_m_per_s2_sqrt_hz = 0.0;
  double gyro_bias_walk_rad_per_s2_sqrt_hz = 0.0;
  double accel_bias_walk_m_per_s3_sqrt_hz = 0.0;
  double wheel_forward_m_per_s = 0.0;   ///< white, per encoder sample; so are the next two
  double wheel_lateral_m_per_s = 0.0;   ///< of the nonholonomic row v_y = 0
  double wheel_vertical_m_per_s = 0.0;  ///< of the nonholonomic row v_z = 0
  double body_velocity_scale = 1.0;     ///< scales the standard deviation that the sensor delivers
  double pose_scale = 1.0;              ///< likewise
  double depth_m = 0.0;                 ///< white, per depth sample; 0: such samples are not used
  double joint_angle_rad = 0.0;         ///< white, per sample and joint of a leg
  double foot_position_m = 0.0;  ///< of what a leg's kinematics leave out, per sample and axis
  double foot_slip_m_per_s_sqrt_hz = 0.0;  ///< white velocity of a standing foot
  double joint_rate_rad_per_s = 0.0;       ///< white, per sample and joint: legs used as a velocity
  double leg_velocity_m_per_s = 0.0;       ///< of a standing foot, likewise, each axis
  double wheel_yaw_rate_rad_per_s = 0.0;   ///< of the wheels' yaw rate, per encoder sample
  double standstill_m_per_s = 0.0;         ///< what may be left of the velocity at standstill
  double standstill_rad_per_s = 0.0;       ///< and of the angular rate
  double floor_height_m = 0.0;             ///< of a flat floor, white, per use
  /// Of the water's velocity, for velocities relative to it; 0: such samples are not used.
  double water_current_m_per_s = 0.0;
};

/// One entry of the flat vector: its stable name (with the unit) and where it lives.
struct NoiseField {
  std::string_view name;
  double Noise::*member;
};

/// All entries of `Noise`, in a fixed order.
std::span<const NoiseField> NoiseFields();

/// What happens to a correction whose NIS lies beyond the χ² quantile of `probability`.
enum class GateAction : std::uint8_t { kOff, kWarn, kReject, kInflate };

struct Gate {
  GateAction action = GateAction::kReject;
  double probability = 0.9999;
  /// With kReject: once most rows have been rejected for this long, the belief is at fault, and is
  /// widened as if the IMU had not been there in that time. 0: never.
  double patience_s = 2.0;
};

/// Standard deviations of the initial error in the filter's own error coordinates.
struct PriorSigma {
  double roll_pitch_rad = 0.02;
  double yaw_rad = 0.01;
  double velocity_m_s = 0.05;
  double position_m = 0.01;
  double gyro_bias_rad_s = 1e-3;
  double accel_bias_m_s2 = 2e-2;
};

/// How a filter finds its first state.
enum class InitialisationKind : std::uint8_t {
  kPrior,   ///< from the prior alone
  kStatic,  ///< roll, pitch and gyroscope bias from a resting IMU; yaw and position from the prior
  kPose,    ///< orientation and position from the first pose sample; the rest from the prior
};

struct Initialisation {
  InitialisationKind kind = InitialisationKind::kPrior;
  double static_duration_s = 1.0;  ///< of rest that is averaged
};

/// What a filter makes of a robot that stands still: zero velocity and zero angular rate.
struct Standstill {
  bool use = false;
  double window_s = 0.25;  ///< the IMU and wheels must be quiet this long
};

/// A floor of one known height under all that stands on it: feet, or else the body's origin.
struct FlatFloor {
  bool use = false;
  double height_m = 0.0;  ///< z in W of a standing foot, or of the body's origin
};

/// What a filter takes a standing foot for.
enum class FootKind : std::uint8_t {
  kRolling,  ///< a sphere that rolls on level ground
  kStatic,   ///< a point that stands [Hartley20]
};

/// How a filter uses a foot that stands.
enum class LegCorrection : std::uint8_t {
  kPosition,  ///< its place is part of the state [Hartley20]
  kVelocity,  ///< leg odometry: the body moves as the leg moves over it
};

/// What a filter makes of the torques of a leg's motors, see `LegLoad`.
enum class ForceModel : std::uint8_t { kStatic, kInertia, kMomentum };

/// How a filter tells which feet stand: by a sensor that says so, or by a force that it compares
/// with thresholds. The latter's defaults are those of [Youm24].
struct ContactDetection {
  std::string sensor;  ///< of contacts, torques or foot forces; empty: the one of the legs
  ForceModel force = ForceModel::kMomentum;  ///< of torques
  double observer_hz = 30.0;                 ///< the momentum observer's pole
  double cutoff_hz = 10.0;    ///< of one pole that the force goes through; 0: as it is
  double threshold_n = 40.0;  ///< a foot stands from this force on
  double hysteresis_n = 0.0;  ///< and until the force has fallen this far below it
  /// Of the probability 1 / (1 + e^(−(f − threshold) / this)); 0: a switch.
  double logistic_n = 0.0;
};

/// How a filter tells that a standing foot slips.
enum class SlipRule : std::uint8_t {
  kOff,
  kSpeed,  ///< its speed by the state and the encoders is above a limit [Kim21]
  kNis,    ///< the NIS of its leg's odometry is beyond a χ² quantile
};

/// And what it does about it.
enum class SlipAction : std::uint8_t {
  kInflate,  ///< widens the foot's own belief
  kDrop,     ///< forgets where the foot stood: it stands anew where the leg says
};

struct SlipRejection {
  SlipRule rule = SlipRule::kOff;
  double speed_m_s = 0.4;     ///< kSpeed
  double factor = 10.0;       ///< kSpeed: on the variance of the foot's velocity while it slips
  double probability = 0.99;  ///< kNis
  SlipAction action = SlipAction::kInflate;  ///< kNis
  double correlation_s = 0.02;               ///< kNis, kInflate: how long a slip keeps its velocity
};

/// The stage that refines the angular rate before it moves the filter.
struct GyroFilter {
  std::string source;  ///< the sensor beside the IMU: another IMU, or the wheels; empty: no stage
  double bias_sigma_rad_s = 1e-2;  ///< turn-on bias of that other IMU, each axis
};

/// Everything that a filter is told before its first measurement: beliefs only.
struct Setup {
  models::Suite suite;
  ErrorForm error = ErrorForm::kRightInvariant;  ///< of the invariant filters
  int iterations = 4;                            ///< of the iterated filter, at most
  double history_s = 0.5;  ///< how late a measurement can be and still be used at its own time
  Standstill standstill;
  FlatFloor floor;
  FootKind feet = FootKind::kRolling;
  LegCorrection leg_correction = LegCorrection::kPosition;
  ContactDetection contacts;
  SlipRejection slip;
  GyroFilter gyro_filter;
  Noise noise;
  Gate gate;
  Initialisation initialisation;
  PriorSigma prior_sigma;
  double gravity_m_s2 = 9.81;
  bool estimate_gyro_bias = true;  ///< false: the state is kept at the prior's with zero covariance
  bool estimate_accel_bias = true;  ///< likewise
};

}  // namespace reckon::estimator
