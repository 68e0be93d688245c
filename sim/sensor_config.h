#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "reckon/models/suite.h"
#include "reckon/sim/leg_sensor_config.h"
#include "reckon/sim/range.h"
#include "reckon/sim/timing.h"

namespace reckon::sim {

/// The errors of one triad (gyroscope or accelerometer), `sensor_models.md` 3.1. SI units; u is
/// rad/s for a gyroscope and m/s² for an accelerometer. Zero means absent.
struct TriadErrors {
  double noise_density = 0.0;     ///< white, u/√Hz
  double bias_walk = 0.0;         ///< random walk, u/s/√Hz
  double bias_instability = 0.0;  ///< stationary σ_B of a first-order Gauss-Markov process, u
  double bias_time_constant_s = 300.0;  ///< its τ
  double turn_on_bias = 0.0;            ///< σ of the bias drawn once a run, u
  double scale = 0.0;                   ///< σ of the scale error drawn once an axis and run
  double misalignment = 0.0;            ///< σ of each off-diagonal term of M drawn once a run, rad
  double g_sensitivity = 0.0;  ///< σ of each entry of G drawn once a run, u/(m/s²); gyroscope only
  double range = 0.0;          ///< clips at ±range and sets the flag; 0: no limit
  double resolution = 0.0;     ///< u per least significant bit; 0: not quantised
};

enum class ImuMode { kIncrement, kPoint };

/// A synthesised IMU. `grade` has already filled the triads when this is read; what the scenario
/// writes beside it wins.
struct ImuConfig {
  Timing timing = {};
  std::string grade = "perfect";
  ImuMode mode = ImuMode::kIncrement;
  TriadErrors gyro = {}, accel = {};
  double bandwidth_hz = 0.0;  ///< of the anti-alias filter inside the physics step; 0: none
  int bandwidth_poles = 2;    ///< 1 or 2
};

/// Rotary encoders of all wheels (or joints), `sensor_models.md` 3.3.
struct EncoderConfig {
  /// Beside `offset_rad`, what each reads too much (empty: nothing): of the actual robot, not a
  /// key.
  std::vector<double> actual_offset_rad = {};
  Timing timing{.rate_hz = 50.0};
  double counts_per_rad = 0.0;    ///< 0: not quantised
  double noise_rad = 0.0;         ///< white, per reading, before quantisation
  double eccentricity_rad = 0.0;  ///< A of A sin(q + φ), φ drawn once a run
  double offset_rad = 0.0;        ///< σ of the constant offset drawn once a run
  double scale = 0.0;             ///< σ of the scale error drawn once an encoder and run
  double rate_window_s = 0.01;    ///< the firmware differences counts over this window
  double rate_filter_hz = 0.0;    ///< and passes that on through one pole; 0: as it is
};

/// An ideal sensor of the body's velocity: white noise and nothing else.
struct BodyVelocityConfig {
  Timing timing{.rate_hz = 20.0};
  Eigen::Vector3d noise_m_per_s = Eigen::Vector3d::Zero();  ///< σ per sample and axis of S
};

/// A pressure sensor that tells how deep its own origin lies.
struct DepthConfig {
  Timing timing{.rate_hz = 10.0};
  double noise_m = 0.0;       ///< σ per sample, white, before quantisation
  double offset_m = 0.0;      ///< σ of the constant offset drawn once a run
  double resolution_m = 0.0;  ///< per least significant bit; 0: not quantised
  /// What it takes the water's density to be; 0: what it is.
  double assumed_density_kg_m3 = 0.0;
  /// Random walk of the depth at which it reads zero, as weather and tide change the surface.
  double surface_drift_m_per_s_sqrt_hz = 0.0;
};

/// An absolute pose from outside: satellites, motion capture, a map.
struct PoseConfig {
  Timing timing{.rate_hz = 10.0};
  Eigen::Vector3d noise_position_m = Eigen::Vector3d::Zero();       ///< σ per sample, axes of W
  Eigen::Vector3d noise_orientation_rad = Eigen::Vector3d::Zero();  ///< likewise, about them
  bool orientation = true;  ///< false: it knows its position alone
};

/// A Doppler velocity log at the level of its beams, `vehicles.md` B. `grade` has already filled
/// what it names when this is read; what the scenario writes beside it wins.
struct DvlConfig {
  Timing timing{.rate_hz = 5.0};  ///< latency: from the last echo to the arrival
  std::string grade = "ideal";
  double beam_angle_deg = 30.0;  ///< from the vertical
  std::vector<double> azimuths_deg{45, 135, 225, 315};
  double noise_m_per_s = 0.001;      ///< σ of one beam's velocity
  double water_noise_m_per_s = 0.0;  ///< the same over water
  double offset_m_per_s = 0.0;       ///< σ of each beam's constant offset drawn once a run
  double scale = 0.0;                ///< σ of the scale error drawn once a run
  double altitude_min_m = 0.1;       ///< of what a beam meets: range times cos θ
  double altitude_max_m = 100.0;
  double max_incidence_deg = 60.0;  ///< a beam that meets the ground flatter gets no echo
  double max_speed_m_s = 100.0;     ///< faster than this no beam answers
  double dropout = 0.0;             ///< probability that a beam gets no echo
  int min_beams = 3;                ///< of those that a velocity needs
  std::vector<std::array<double, 2>> rate_by_altitude = {};  ///< rows [up to this altitude m, Hz]
  double assumed_sound_speed_m_s = 0.0;                      ///< 0: what it is
  bool water_track = false;    ///< without the ground it reports its velocity relative to the water
  double water_layer_m = 5.0;  ///< how far under it that water is

  static constexpr Range kBeamAngle{1, 89}, kIncidence = AboveUpTo(0, 90);
  static constexpr Range kAltitude{0, 10000}, kMinBeams{3, 8};
};

/// The sensors that can be simulated. Several types may send the same kind of sample.
enum class SensorType {
  kImu,
  kEncoders,
  kBodyVelocity,
  kDepth,
  kPose,
  kDvl,
  kContacts,
  kTorques,
  kFootForces,
};

/// What a sensor of each type gets wrong, in the order of `SensorType`.
using SensorErrors =
    std::variant<ImuConfig, EncoderConfig, BodyVelocityConfig, DepthConfig, PoseConfig, DvlConfig,
                 ContactSensorConfig, TorqueConfig, FootForceConfig>;

inline SensorType TypeOf(const SensorErrors& errors) {
  return static_cast<SensorType>(errors.index());
}

/// The kind of sample that a sensor with these errors sends.
models::SensorKind KindOf(const SensorErrors& errors);

enum class FaultKind {
  kDropout,       ///< nothing is sent
  kStuck,         ///< the last good sample is sent again and again, freshly stamped
  kBiasStep,      ///< `magnitude` is added to every channel (in the channel's own unit)
  kScaleStep,     ///< every channel is multiplied by `magnitude`
  kSaturation,    ///< every channel is clipped at ±`magnitude`; IMU flags are set
  kExtraDelay,    ///< `magnitude` seconds later
  kTimeJitter,    ///< validity is misreported by N(0, `magnitude`²) seconds; a message that
                  ///< claims to be valid after its arrival arrives then
  kOutlierBurst,  ///< with probability 0.3 a sample gets N(0, `magnitude`²) on every channel
  kNanBurst,      ///< every channel is not a number
};

/// Which of a sensor's channels a fault strikes. The others are left alone.
enum class FaultChannels {
  kAll,
  kGyro,   ///< IMU: angular velocity
  kAccel,  ///< IMU: specific force
  kAngle,  ///< encoders: angles
  kRate,   ///< encoders: rates
};

/// One entry of the fault schedule: acts on samples valid in [at_s, at_s + for_s).
struct FaultConfig {
  std::string sensor;
  FaultKind kind = FaultKind::kDropout;
  double at_s = 0.0;
  double for_s = 1.0;
  double magnitude = 0.0;
  /// For kinds that change channels (bias step to saturation, outliers, NaN). One magnitude is
  /// rarely right for both units of a sensor. The channels of a pose sensor are its position: its
  /// orientation is left alone.
  FaultChannels channels = FaultChannels::kAll;

  static constexpr Range kDelay = AboveUpTo(0, 60), kJitter = AboveUpTo(0, 10);
  static constexpr Range kLimit = AboveUpTo(0, 1e6), kOutlier = AboveUpTo(0, 1e6);
  static constexpr Range kOffset{-1e6, 1e6}, kFactor{-1e3, 1e3};
  static constexpr Range kStart{0, 1e6}, kDuration = AboveUpTo(0, 1e6);
};

/// Whether a sensor with these errors has the channels: all sensors have `kAll`.
bool HasChannels(const SensorErrors& sensor, FaultChannels channels);

}  // namespace reckon::sim
