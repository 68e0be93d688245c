#pragma once

#include <array>

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void DescribeKind(Archive& a, sim::SkidSteerConfig& d) {
  a.Field("left_joints", d.left_joints, "URDF joints of the left wheels, front to rear");
  a.Field("right_joints", d.right_joints, "URDF joints of the right wheels, front to rear");
  a.Field("wheel_radius_m", d.wheel_radius_m, "Undeformed radius of the tyre", AboveUpTo(0, 5));
  a.Field("wheel_armature_kg_m2", d.wheel_armature_kg_m2, "Reflected inertia of motor and gear",
          Between(0, 100));
  a.Field("wheel_damping_n_m_s", d.wheel_damping_n_m_s, "Viscous friction of a wheel's axle",
          Between(0, 100));
  a.Field("torque_limit_n_m", d.torque_limit_n_m, "Most that the motors give at each wheel",
          AboveUpTo(0, 1e4));
  a.Field("speed_kp", d.speed_kp, "Speed loop, N m per rad/s", Between(0, 1e4));
  a.Field("speed_ki", d.speed_ki, "Speed loop, N m per rad", Between(0, 1e5));
  a.Field("belt_stiffness_n_m_rad", d.belt_stiffness_n_m_rad,
          "The belt that makes the wheels of a side turn together", Between(0, 1e6));
  a.Field("belt_damping_n_m_s", d.belt_damping_n_m_s, "Likewise", Between(0, 1e5));
  a.Field("max_acceleration_m_s2", d.max_acceleration_m_s2, "Ramp of the commanded speed",
          AboveUpTo(0, 100));
  a.Field("max_yaw_acceleration_rad_s2", d.max_yaw_acceleration_rad_s2,
          "Ramp of the commanded turn rate", AboveUpTo(0, 100));
  a.Field("command_track_m", d.command_track_m, "Track that turns (v, turn rate) into wheel speeds",
          AboveUpTo(0, 10));
  a.Field("bristle_stiffness_n_m", d.bristle_stiffness_n_m, "Tyre: stiffness along the ground",
          AboveUpTo(0, 1e8));
  a.Field("bristle_damping_n_s_m", d.bristle_damping_n_s_m, "Tyre: damping along the ground",
          Between(0, 1e6));
  a.Field("relaxation_length_m", d.relaxation_length_m, "Tyre: relaxation length",
          AboveUpTo(0, 10));
  a.Field("normal_stiffness_n_m", d.normal_stiffness_n_m, "Tyre: stiffness across the ground",
          AboveUpTo(0, 1e8));
  a.Field("normal_damping_n_s_m", d.normal_damping_n_s_m, "Tyre: damping across the ground",
          Between(0, 1e6));
}

/// The rows of an added mass, and what rows say.
using Rows6 = std::array<std::array<double, 6>, 6>;
Rows6 RowsOf(const sim::Matrix6& matrix);
sim::Matrix6 MatrixOf(const Rows6& rows);

template <class Archive>
void Describe(Archive& a, sim::HydrodynamicsConfig& h) {
  a.Field("volume_m3", h.volume_m3, "Water displaced when submerged", Between(0, 1e5));
  a.Field("centre_of_buoyancy_m", h.p_BV_m, "In body axes", Between(-100, 100));
  Rows6 rows = RowsOf(h.added_mass);
  a.Field("added_mass", rows,
          "Six rows, of surge, sway, heave, roll, pitch and yaw: kg, kg m and kg m^2 about the "
          "body's origin, forward-left-up; symmetric, without negative eigenvalues");
  h.added_mass = MatrixOf(rows);
  a.Field("linear_damping", h.linear_damping, "Along and about the body's axes, N s/m and N m s",
          Between(0, 1e6));
  a.Field("quadratic_damping", h.quadratic_damping, "Likewise, N s^2/m^2 and N m s^2",
          Between(0, 1e6));
}

template <class Archive>
void Describe(Archive& a, sim::ThrusterConfig& t) {
  a.Field("at_m", t.p_BT_m, "Where it pushes, body axes", Between(-100, 100), Need::kHere);
  a.Field("direction", t.direction, "Of positive thrust, body axes", Between(-1, 1), Need::kHere);
  a.Field("limit_n", t.limit_n, "Most thrust, either way", AboveUpTo(0, 1e6));
  a.Field("lag_s", t.lag_s, "Time constant of first order", Between(0, 10));
}

template <class Archive>
void Describe(Archive& a, sim::AutopilotConfig& c) {
  const auto gain = [&a](const char* key, double& value, const char* doc) {
    a.Field(key, value, doc, Between(0, 1e6));
  };
  gain("surge_n_s_m", c.surge_n_s_m, "Force forward for an error of speed");
  gain("surge_n_m", c.surge_n_m, "and for its integral");
  gain("sway_n_s_m", c.sway_n_s_m, "The same to the left");
  gain("sway_n_m", c.sway_n_m, "and for its integral");
  gain("heave_n_s_m", c.heave_n_s_m, "The same upwards");
  gain("heave_n_m", c.heave_n_m, "and for its integral");
  gain("tilt_n_m_rad", c.tilt_n_m_rad, "Moment against roll and pitch");
  gain("tilt_n_m_s", c.tilt_n_m_s, "and against their rates");
  gain("yaw_n_m_s", c.yaw_n_m_s, "Moment for an error of the yaw rate");
  gain("heading_1_s", c.heading_1_s, "Yaw rate for an error of heading");
  gain("max_yaw_rate_rad_s", c.max_yaw_rate_rad_s, "Largest yaw rate that is asked for");
}

template <class Archive>
void DescribeKind(Archive& a, sim::UnderwaterConfig& u) {
  a.Field("hydrodynamics", u.hydrodynamics, "What the water does");
  a.Field("thrusters", u.thrusters, "What pushes");
  a.Field("autopilot", u.autopilot, "Gains of the control loops");
}

template <class Archive>
void DescribeKind(Archive& a, sim::LeggedConfig& l) {
  using Legged = sim::LeggedConfig;
  a.Field("feet", l.feet, "URDF links: front right, front left, rear right, rear left");
  a.Field("foot_radius_m", l.foot_radius_m, "Of the sphere around a foot's origin",
          Within(Legged::kFootRadius));
  a.Field("armature_kg_m2", l.armature_kg_m2,
          "Reflected inertia of a leg's motors, from the body outwards", Within(Legged::kArmature));
  a.Field("damping_n_m_s", l.damping_n_m_s, "Viscous friction of its joints",
          Within(Legged::kFriction));
  a.Field("friction_n_m", l.friction_n_m, "Dry friction of its joints", Within(Legged::kFriction));
  a.Field("stand_angles_rad", l.stand_angles_rad, "Its joints when it stands",
          Within(Legged::kAngle));
  a.Field("swing_stiffness_n_m", l.swing_stiffness_n_m, "What guides a foot through the air",
          Within(Legged::kStiffness));
  a.Field("swing_damping_n_s_m", l.swing_damping_n_s_m, "Likewise", Within(Legged::kDamping));
  a.Field("max_acceleration_m_s2", l.max_acceleration_m_s2, "Ramp of the commanded velocity",
          Within(Legged::kAcceleration));
  a.Field("max_yaw_acceleration_rad_s2", l.max_yaw_acceleration_rad_s2,
          "Ramp of the commanded turn rate", Within(Legged::kAcceleration));
}

/// What a robot's drive is before anything is written.
sim::DriveConfig DefaultDrive(sim::DriveKind kind);

template <class Archive>
void Describe(Archive& a, sim::DriveConfig& d) {
  sim::DriveKind kind = sim::KindOf(d);
  a.Kind("type", kind, Choices<sim::DriveKind>(), "What moves the robot");
  if (kind != sim::KindOf(d)) d = DefaultDrive(kind);
  std::visit([&a](auto& drive) { DescribeKind(a, drive); }, d);
}

}  // namespace reckon::harness
