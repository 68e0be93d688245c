#pragma once

#include "reckon/sim/timing.h"

namespace reckon::sim {

enum class ContactSource {
  kTruth,  ///< the feet that press on the ground
  kGait,   ///< the feet that the walking controller's schedule has down
};

/// Which feet stand, without error.
struct ContactSensorConfig {
  Timing timing{.rate_hz = 500.0};
  ContactSource source = ContactSource::kTruth;
};

/// The errors of one channel of a torque or force sensor, in its unit (N m, N). Zero means absent.
struct LoadErrors {
  double noise = 0.0;       ///< white, σ per sample
  double offset = 0.0;      ///< σ of the constant offset drawn once a channel and run
  double scale = 0.0;       ///< σ of the scale error drawn once a channel and run
  double range = 0.0;       ///< clips at ±range; 0: no limit
  double resolution = 0.0;  ///< per least significant bit; 0: not quantised
};

enum class TorqueSource {
  kCommanded,  ///< what the controller asked the motors for, without error
  kMeasured,   ///< what the motors gave, as a sensor (or their current) tells it
};

/// Torques of all joints' motors, behind the gear.
struct TorqueConfig {
  Timing timing{.rate_hz = 500.0};
  TorqueSource source = TorqueSource::kMeasured;
  LoadErrors errors = {};  ///< of what is measured
};

/// A sensor of the force along the ground's normal in every foot.
struct FootForceConfig {
  Timing timing{.rate_hz = 500.0};
  LoadErrors errors = {};
};

}  // namespace reckon::sim
