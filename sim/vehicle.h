#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "reckon/ground_truth/truth.h"
#include "reckon/models/encoder_sample.h"
#include "reckon/models/pose.h"
#include "reckon/sim/mujoco_model.h"
#include "reckon/sim/surroundings.h"

namespace reckon::sim {

/// A simulated robot at one instant.
struct VehicleState {
  models::Pose X_WB;
  models::EncoderVector joint_angle_rad, joint_rate_rad_s;    ///< as the encoders count them
  models::EncoderVector joint_command_n_m, joint_torque_n_m;  ///< of legs: asked for, and given
  ground_truth::FeetTruth feet;
  models::FootVector gait;  ///< 1 for each foot that the gait has down
  models::EncoderVector wheel_slip_m_s, wheel_load_n;
  Eigen::Vector3d water_velocity_m_s = Eigen::Vector3d::Zero();  ///< around it, in W
};

/// A robot in MuJoCo with what moves it: its controller, its motors and the forces of its medium.
/// Derived classes build the model, place the robot where it starts and step it.
class Vehicle {
 public:
  virtual ~Vehicle() = default;
  Vehicle(const Vehicle&) = delete;
  Vehicle& operator=(const Vehicle&) = delete;

  /// Of the positions and velocities of the physics. No function allocates.
  virtual VehicleState Read() = 0;

  /// One step of the physics from the instant `t_ns` on (negative before the run: the robot keeps
  /// its place), of which `now` is the state; what depends on the forces is written to it.
  virtual void Step(models::TimeNs t_ns, VehicleState& now) = 0;

  /// Whether it is as still as it can be, so that a run can begin.
  virtual bool IsSettled() const = 0;

  /// It has come to rest: brakes are released. The steps up to t = 0 follow.
  virtual void Release() {}

  /// What ends the run in this state: the robot left the map, turned over; nothing if all is well.
  virtual std::optional<std::string> Trouble(const VehicleState& state) const = 0;

  /// What sensors can see; null if there is nothing that they could.
  virtual const Surroundings* surroundings() const { return nullptr; }

  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 protected:
  explicit Vehicle(ModelPtr model) : model_(std::move(model)), data_(MakeData(*model_)) {}

  ModelPtr model_;
  DataPtr data_;
};

/// How many physics steps lie between two calls of a controller: at least one.
inline long long StepsPerCall(double rate_hz, double step_s) {
  return std::max(1LL, std::llround(1.0 / (rate_hz * step_s)));
}

/// The same in nanoseconds.
inline models::TimeNs NsPerCall(double rate_hz, double step_s) {
  return StepsPerCall(rate_hz, step_s) * std::llround(step_s * 1e9);
}

}  // namespace reckon::sim
