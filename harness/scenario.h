#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reckon/estimator/setup.h"
#include "reckon/ground_truth/score_options.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/sensor_config.h"
#include "reckon/sim/world_config.h"

namespace reckon::harness {

/// One sensor of the simulated robot.
struct SensorConfig {
  std::string frame;  ///< the URDF link that is the sensor's frame S
  sim::SensorErrors errors;
};

enum class NoiseSource { kNominal, kMatched, kGiven };

/// One estimator under test: beliefs, not facts.
struct EstimatorConfig {
  std::string type = "inekf";  ///< a name of the registry, or `process`
  estimator::ErrorForm error = estimator::ErrorForm::kRightInvariant;  ///< inekf
  std::vector<std::string> command;  ///< process: the program and its arguments
  /// process: where the command runs; relative to the scenario file's folder, which is the default
  std::string working_folder;
  double timeout_s = 10.0;  ///< process: the longest wait for an answer
  NoiseSource noise_source = NoiseSource::kNominal;
  estimator::Noise noise;  ///< resolved numbers, whatever their source
  estimator::Gate gate;
  estimator::Initialisation initialisation;
  int iterations = 4;      ///< iterated_inekf: of a correction, at most
  double history_s = 0.5;  ///< how late a measurement can be and still be used at its own time
  estimator::Standstill standstill;
  estimator::FlatFloor floor;
  estimator::FootKind feet = estimator::FootKind::kRolling;
  estimator::LegCorrection leg_correction = estimator::LegCorrection::kPosition;
  estimator::ContactDetection contacts;
  estimator::SlipRejection slip;
  estimator::GyroFilter gyro_filter;
  bool estimate_gyro_bias = true;
  bool estimate_accel_bias = true;
  std::vector<std::string> sensors;  ///< those that it is given; empty: all
  /// Believed mounting that differs from the nominal one, by sensor: a deliberate defect.
  std::map<std::string, std::array<double, 6>> mounting_error;  ///< [x y z m, rotation vector deg]
};

/// How all estimators of a run start.
struct InitialConfig {
  bool sample_error = true;     ///< draw the initial error from P₀; false: start at truth
  estimator::PriorSigma sigma;  ///< P₀, right-invariant
};

/// Which streams of the recording are written, and how often truth is.
struct RecordConfig {
  bool truth = true, measurements = true, estimates = true, covariance = true, innovations = true;
  double truth_rate_hz = 1000.0;  ///< an integer fraction of the physics rate
  double estimate_rate_hz = 0.0;  ///< 0: every estimate; else the first at or after each period
};

/// A bound on one metric of one estimator.
struct Bound {
  std::string metric;
  std::optional<double> min, max;
};

/// What is expected of one estimator.
struct Expectation {
  std::vector<Bound> bounds;
  std::optional<double> consistency_false_alarm;  ///< `consistency: {false_alarm: …}`
};

/// `a.metric < factor * b.metric`, as written under `expect: compare:`.
struct Comparison {
  std::string text;  ///< as written
  std::string left_estimator, left_metric, right_estimator, right_metric;
  bool less = true;     ///< `<`; false: `>`
  double factor = 1.0;  ///< scales the right side: `riekf.x < 0.8 * mekf.x`
};

struct ExpectConfig {
  std::map<std::string, Expectation> estimators;
  std::vector<Comparison> compare;
  std::optional<int>
      exit_code;  ///< for scenarios whose point is to fail (a run that must end with 3)
};

/// The wheels that the estimators believe in.
struct NominalWheels {
  std::string encoders;  ///< the sensor that reports them; empty: no wheels
  double rolling_radius_m = 0.0;
  double effective_track_m = 0.0;    ///< slip included
  std::array<double, 3> origin_m{};  ///< in B: where forward speed and nonholonomic rows hold
};

/// The legs that the estimators believe in; their kinematics are the URDF's.
struct NominalLegs {
  std::string encoders;  ///< the sensor that reports the joints; empty: no legs
  std::string contacts;  ///< the sensor that says which feet stand
  double foot_radius_m = 0.0;
};

/// What the estimators believe of the robot, beside its URDF.
struct NominalConfig {
  NominalWheels wheels;
  NominalLegs legs;
  estimator::Noise noise;  ///< of estimators with `noise: nominal`
};

/// A scenario with every default filled in: a run is a pure function of it.
struct Scenario {
  int schema = 1;
  std::string description;
  std::string log;        ///< a folder with a log that stands in for the simulator; empty: none
  std::string recording;  ///< likewise one of our own recordings
  std::string robot = "husky";
  double duration_s = 60.0;
  std::uint64_t seed = 1;
  sim::WorldConfig world;  ///< `world:`, `motion:`, `mission:` and `actual:`
  sim::DriveConfig drive;  ///< of the simulated robot
  NominalConfig nominal;
  std::map<std::string, SensorConfig> sensors;
  std::vector<sim::FaultConfig> faults;
  InitialConfig initial;
  std::map<std::string, EstimatorConfig> estimators;
  ground_truth::ScoreOptions score;
  RecordConfig record;
  ExpectConfig expect;
};

}  // namespace reckon::harness
