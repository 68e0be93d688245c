#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reckon/models/measurement.h"
#include "reckon/sim/motion_window.h"
#include "reckon/sim/sensor.h"

// Motions in closed form, seen through the windows that the simulator would give.
namespace reckon::testing_sim {

/// A vehicle that drives a Lissajous figure, turns, rolls and pitches, by angles of some tenths of
/// a radian about means that differ from the start: R = Rz(ψ) Ry(θ) Rx(φ).
class RoughRide {
 public:
  models::Pose At(double t) const {
    const double roll = 0.12 - 0.12 * std::cos(1.9 * t) + 0.01 * std::sin(19.0 * t);
    const double pitch = 0.10 * std::sin(2.3 * t) + 0.01 * std::sin(23.0 * t);
    const double yaw = 1.5 * std::sin(0.3 * t) + 0.02 * std::sin(5.0 * t);
    models::Pose X_WB;
    X_WB.R = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                 .toRotationMatrix();
    X_WB.p = {4.0 * std::sin(0.2 * t), 3.0 * std::sin(0.31 * t),
              0.03 * std::sin(6.0 * t) + 0.002 * std::sin(31.0 * t)};
    return X_WB;
  }
};

/// A body at rest, level, at the origin.
struct Rest {
  models::Pose At(double) const { return {}; }
};

/// The window that the simulator gives at `t_ns`.
template <typename Motion>
sim::MotionWindow WindowAt(const Motion& motion, models::TimeNs t_ns, models::TimeNs step_ns) {
  sim::MotionWindow window;
  window.t_ns = t_ns;
  window.step_ns = step_ns;
  window.X_WB_previous = motion.At(models::Seconds(t_ns - step_ns));
  window.X_WB = motion.At(models::Seconds(t_ns));
  window.X_WB_next = motion.At(models::Seconds(t_ns + step_ns));
  return window;
}

/// Everything that `sensor` (or a suite of them) says about `motion` from 0 to `end_ns`.
template <typename Observer, typename Motion>
std::vector<models::Measurement> Watch(Observer& sensor, const Motion& motion,
                                       models::TimeNs step_ns, models::TimeNs end_ns) {
  std::vector<models::Measurement> out;
  for (models::TimeNs t_ns = 0; t_ns <= end_ns; t_ns += step_ns) {
    sensor.Observe(WindowAt(motion, t_ns, step_ns), out);
  }
  return out;
}

/// The pose of a sensor that sits off the body's origin and is turned about no axis of it.
inline models::Pose SlantedMounting() {
  models::Pose X_BS;
  X_BS.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  X_BS.p = {0.19, -0.05, 0.149};
  return X_BS;
}

}  // namespace reckon::testing_sim
