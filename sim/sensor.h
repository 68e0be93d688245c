#pragma once

#include <vector>

#include "reckon/models/measurement.h"
#include "reckon/sim/motion_window.h"

namespace reckon::sim {

/// A synthesised sensor: it watches the motion and speaks when it has something to say.
class Sensor {
 public:
  virtual ~Sensor() = default;

  /// Called once for each physics step, in order, from t = 0 on. Appends what became complete at
  /// `motion.t_ns`, stamped with its times of validity and of arrival.
  virtual void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) = 0;
};

}  // namespace reckon::sim
