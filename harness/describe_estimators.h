#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, estimator::Noise& n) {
  a.Field("gyro_noise_density_rad_per_s_sqrt_hz", n.gyro_noise_density_rad_per_s_sqrt_hz,
          "Gyroscope, white", Between(0, 10));
  a.Field("accel_noise_density_m_per_s2_sqrt_hz", n.accel_noise_density_m_per_s2_sqrt_hz,
          "Accelerometer, white", Between(0, 100));
  a.Field("gyro_bias_walk_rad_per_s2_sqrt_hz", n.gyro_bias_walk_rad_per_s2_sqrt_hz,
          "Random walk of the gyroscope's bias", Between(0, 10));
  a.Field("accel_bias_walk_m_per_s3_sqrt_hz", n.accel_bias_walk_m_per_s3_sqrt_hz,
          "Random walk of the accelerometer's bias", Between(0, 100));
  a.Field("wheel_forward_m_per_s", n.wheel_forward_m_per_s,
          "Forward speed from the wheels, white, a sample", Between(0, 100));
  a.Field("wheel_lateral_m_per_s", n.wheel_lateral_m_per_s,
          "Of the condition that the robot does not slide sideways", Between(0, 100));
  a.Field("wheel_vertical_m_per_s", n.wheel_vertical_m_per_s,
          "Of the condition that the robot does not lift off", Between(0, 100));
  a.Field("body_velocity_scale", n.body_velocity_scale,
          "Factor on the sigma that a velocity sensor delivers", AboveUpTo(0, 1e3));
  a.Field("pose_scale", n.pose_scale, "Factor on the sigmas that a pose sensor delivers",
          AboveUpTo(0, 1e3));
  a.Field("depth_m", n.depth_m, "Depth, white, a sample", Between(0, 100));
  a.Field("joint_angle_rad", n.joint_angle_rad, "Angle of a leg's joint, white, a sample",
          Between(0, 1));
  a.Field("foot_position_m", n.foot_position_m,
          "Of what a leg's kinematics leave out, each axis, a sample", Between(0, 10));
  a.Field("foot_slip_m_per_s_sqrt_hz", n.foot_slip_m_per_s_sqrt_hz,
          "Velocity of a standing foot, white", Between(0, 100));
  a.Field("joint_rate_rad_per_s", n.joint_rate_rad_per_s,
          "Rate of a leg's joint, white, a sample: of legs used as a velocity", Between(0, 100));
  a.Field("leg_velocity_m_per_s", n.leg_velocity_m_per_s,
          "Velocity of a standing foot, white, a sample, each axis: likewise", Between(0, 100));
  a.Field("wheel_yaw_rate_rad_per_s", n.wheel_yaw_rate_rad_per_s,
          "Turn rate from the wheels, white, a sample", Between(0, 100));
  a.Field("standstill_m_per_s", n.standstill_m_per_s,
          "What may be left of the velocity at standstill", Between(0, 100));
  a.Field("standstill_rad_per_s", n.standstill_rad_per_s,
          "What may be left of the turn rate at standstill", Between(0, 10));
  a.Field("water_current_m_per_s", n.water_current_m_per_s,
          "Of the water's velocity, for velocities relative to it; 0: they are not used",
          Between(0, 10));
  a.Field("floor_height_m", n.floor_height_m, "Height of a flat floor, white, a use",
          Between(0, 100));
}

template <class Archive>
void Describe(Archive& a, estimator::Gate& g) {
  a.Field("action", g.action, "What happens to a correction beyond the gate");
  a.Field("probability", g.probability, "Chi-square quantile of the gate",
          AboveUpTo(0.5, 1 - 1e-12));
  a.Field("patience_s", g.patience_s,
          "Reject: when most rows have been rejected for this long, the belief is widened instead; "
          "0: never",
          Between(0, 1e4));
}

template <class Archive>
void Describe(Archive& a, estimator::Initialisation& i) {
  using Kind = estimator::InitialisationKind;
  a.Kind("kind", i.kind, Choices<Kind>(), "How the first state is found");
  if (i.kind == Kind::kStatic) {
    a.Field("static_duration_s", i.static_duration_s, "Rest that is averaged", AboveUpTo(0, 3600));
  }
}

template <class Archive>
void Describe(Archive& a, estimator::Standstill& s) {
  a.Field("use", s.use, "Take a robot that stands still for one: zero velocity, zero turn rate");
  a.Field("window_s", s.window_s, "The IMU and wheels must be quiet this long", AboveUpTo(0, 60));
}

template <class Archive>
void Describe(Archive& a, estimator::FlatFloor& f) {
  a.Field("use", f.use, "Take the ground for a floor of one known height");
  a.Field("height_m", f.height_m, "z of a standing foot, or else of the body's origin",
          Between(-1e4, 1e4));
}

template <class Archive>
void Describe(Archive& a, estimator::ContactDetection& c) {
  a.Field("sensor", c.sensor,
          "The contact, torque or foot force sensor that it believes; empty: the robot's contacts");
  a.Field("force_model", c.force, "What is made of torques");
  a.Field("observer_hz", c.observer_hz, "Pole of the momentum observer", AboveUpTo(0, 1e4));
  a.Field("cutoff_hz", c.cutoff_hz, "One pole that forces go through; 0: none", Between(0, 1e4));
  a.Field("threshold_n", c.threshold_n, "A foot stands from this upward force on", Between(0, 1e5));
  a.Field("hysteresis_n", c.hysteresis_n, "And until the force has fallen this far below it",
          Between(0, 1e5));
  a.Field("logistic_n", c.logistic_n,
          "Width of a logistic probability around the threshold; 0: a switch", Between(0, 1e5));
}

template <class Archive>
void Describe(Archive& a, estimator::SlipRejection& s) {
  using Rule = estimator::SlipRule;
  a.Kind("rule", s.rule, Choices<Rule>(), "What tells that a standing foot slips");
  if (s.rule == Rule::kSpeed) {
    a.Field("speed_m_s", s.speed_m_s, "A faster foot slips", AboveUpTo(0, 100));
    a.Field("factor", s.factor, "On the variance of the velocity of a foot that slips",
            Between(1, 1e6));
  }
  if (s.rule == Rule::kNis) {
    a.Field("probability", s.probability, "Chi-square quantile of the NIS of its leg's odometry",
            AboveUpTo(0.5, 1 - 1e-12));
    a.Field("action", s.action, "What becomes of a foot beyond it");
    a.Field("correlation_s", s.correlation_s, "Inflate: how long a slip keeps its velocity",
            AboveUpTo(0, 10));
  }
}

template <class Archive>
void Describe(Archive& a, estimator::GyroFilter& g) {
  a.Field("source", g.source,
          "The sensor that refines the angular rate beside the IMU: another IMU, or the wheels' "
          "encoders; empty: none");
  a.Field("bias_sigma_rad_s", g.bias_sigma_rad_s, "Turn-on bias of that other IMU, each axis",
          Between(0, 10));
}

template <class Archive>
void Describe(Archive& a, estimator::PriorSigma& p) {
  a.Field("roll_pitch_rad", p.roll_pitch_rad, "Roll and pitch", Between(0, 3.2));
  a.Field("yaw_rad", p.yaw_rad, "Yaw", Between(0, 3.2));
  a.Field("velocity_m_s", p.velocity_m_s, "Velocity, each axis", Between(0, 100));
  a.Field("position_m", p.position_m, "Position, each axis", Between(0, 1e4));
  a.Field("gyro_bias_rad_s", p.gyro_bias_rad_s, "Gyroscope bias, each axis", Between(0, 10));
  a.Field("accel_bias_m_s2", p.accel_bias_m_s2, "Accelerometer bias, each axis", Between(0, 100));
}

template <class Archive>
void Describe(Archive& a, InitialConfig& i) {
  a.Field("sample_error", i.sample_error,
          "Draw the initial error from the prior; false: start at the truth");
  a.Field("sigma", i.sigma, "The prior, right-invariant standard deviations");
}

template <class Archive>
void Describe(Archive& a, EstimatorConfig& e) {
  a.Kind("type", e.type, std::span<const Choice<std::string>>(EstimatorTypes()),
         "Which estimator: `reckon list estimators`");
  const bool is_process = e.type == "process";
  if (is_process) {
    a.Field("command", e.command, "The program and its arguments", {}, Need::kSomewhere);
    a.Field("working_folder", e.working_folder,
            "Where it runs, relative to this file's folder, which is the default");
    a.Field("timeout_s", e.timeout_s, "Longest wait for an answer", AboveUpTo(0, 3600));
  }
  if (e.type == "inekf") a.Field("error", e.error, "The error that the filter keeps");
  if (e.type != "odometry") {  // which weighs nothing
    a.WordOr("noise", e.noise_source, Choices<NoiseSource>(), NoiseSource::kGiven, e.noise,
             "The noise believed; numbers that are not given are nominal");
    a.Field("gate", e.gate, "Test of every correction's normalised innovation squared");
    a.Field("initialisation", e.initialisation, "How the first state is found");
    if (is_process || e.type == "iterated_inekf") {
      a.Field("iterations", e.iterations, "Of one correction, at most", Between(1, 20));
    }
    a.Field("history_s", e.history_s,
            "How late a measurement can be and still be used at its own time", Between(0, 10));
    a.Field("standstill", e.standstill, "What is made of a robot that stands still");
    a.Field("floor", e.floor, "What is made of flat ground");
    a.Field("feet", e.feet, "What a standing foot is taken for");
    a.Field("leg_correction", e.leg_correction, "How a standing foot is used");
    a.Field("contacts", e.contacts, "How it is told which feet stand");
    a.Field("slip", e.slip, "What is made of feet that slip");
    a.Field("gyro_filter", e.gyro_filter, "The stage that refines the angular rate");
    a.Field("estimate_gyro_bias", e.estimate_gyro_bias, "false: keeps the prior's");
    a.Field("estimate_accel_bias", e.estimate_accel_bias, "false: keeps the prior's");
  }
  a.Field("sensors", e.sensors, "The sensors that it is given; empty: all");
  a.Field("mounting_error", e.mounting_error,
          "Believed minus nominal mounting by sensor, [x, y, z, rotation vector] in m and degrees: "
          "a deliberate defect");
}

}  // namespace reckon::harness
