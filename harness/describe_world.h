#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, sim::TerrainConfig& t) {
  using Kind = sim::TerrainKind;
  using Terrain = sim::TerrainConfig;
  a.Kind("kind", t.kind, Choices<Kind>(), "The form of the ground");
  a.Field("friction", t.friction, "Friction coefficient of the tyres", Within(Terrain::kFriction));
  a.Field("rolling_resistance", t.rolling_resistance,
          "Rolling resistance coefficient (0.015 hard ground, 0.05 grass)",
          Within(Terrain::kRollingResistance));
  a.Field("half_size_m", t.half_size_m,
          "The map is the square |x|, |y| <= half_size_m; leaving it ends the run",
          Within(t.kind == Kind::kRough ? Terrain::kRoughHalfSize : Terrain::kHalfSize));
  if (t.kind == Kind::kSlope) {
    a.Field("angle_deg", t.angle_deg, "Inclination", Within(Terrain::kAngle));
    a.Field("uphill_deg", t.uphill_deg, "Direction of ascent, from +x towards +y",
            Within(Terrain::kUphill));
  }
  if (t.kind == Kind::kRough) {
    a.Field("rms_m", t.rms_m, "Standard deviation of the height", Within(Terrain::kRms));
    a.Field("shortest_wave_m", t.shortest_wave_m, "Shortest wavelength", Within(Terrain::kWave));
    a.Field("longest_wave_m", t.longest_wave_m, "Longest wavelength", Within(Terrain::kWave));
  }
  if (t.kind == Kind::kKerbs) {
    a.Field("kerb_height_m", t.kerb_height_m, "Height of a kerb", Within(Terrain::kKerbHeight));
    a.Field("kerb_width_m", t.kerb_width_m, "Width of a kerb along x", Within(Terrain::kKerbWidth));
    a.Field("kerb_spacing_m", t.kerb_spacing_m, "Distance from kerb to kerb along x",
            Within(Terrain::kKerbSpacing));
  }
}

template <class Archive>
void Describe(Archive& a, sim::PatchConfig& p) {
  a.Field("box_m", p.box_m, "Centre x, centre y, size along x, size along y",
          Within(sim::PatchConfig::kBox), Need::kHere);
  a.Field("friction", p.friction, "Friction coefficient inside",
          Within(sim::TerrainConfig::kFriction));
}

/// The `world:` section; motion and actual robot are sections of their own.
template <class Archive>
void Describe(Archive& a, sim::WorldConfig& w) {
  a.Field("physics_step_s", w.physics_step_s, "Step of the physics, a whole number of nanoseconds",
          Within(sim::WorldConfig::kPhysicsStep));
  a.Field("gravity_m_s2", w.gravity_m_s2, "Gravity, downwards", Within(sim::WorldConfig::kGravity));
  a.Field("settle_s", w.settle_s, "Time in which the robot comes to rest before t = 0",
          Within(sim::WorldConfig::kSettle));
  a.Field("terrain", w.terrain, "The ground");
  a.Field("patches", w.patches, "Rectangles with another friction; later ones win");
}

template <class Archive>
void Describe(Archive& a, sim::MotionConfig& m) {
  using Kind = sim::PathKind;
  a.Kind("path", m.path, Choices<Kind>(), "What the driver is asked to do");
  if (m.path != Kind::kStand) {
    a.Field("start_s", m.start_s, "The robot stands still until then", Between(0, 1e5));
  }
  if (m.path != Kind::kStand && m.path != Kind::kVelocityProfile) {
    a.Field("speed_m_s", m.speed_m_s, "Cruising speed", AboveUpTo(0, 20));
  }
  if (m.path == Kind::kSquare) {
    a.Field("side_m", m.side_m, "Side of the square", AboveUpTo(0, 1000));
  }
  if (m.path == Kind::kCircle || m.path == Kind::kFigureEight) {
    a.Field("radius_m", m.radius_m, "Radius of the circle or of each lobe", AboveUpTo(0, 1000));
  }
  if (m.path == Kind::kSquare || m.path == Kind::kCircle || m.path == Kind::kFigureEight) {
    a.Field("laps", m.laps, "Laps, then it stops", AboveUpTo(0, 1e6));
    a.Field("clockwise", m.clockwise, "The other way round");
  }
  if (m.path == Kind::kWaypoints) {
    a.Field("waypoints_m", m.waypoints_m, "Points [x, y], at least one", Between(-1e4, 1e4));
  }
  if (m.path == Kind::kVelocityProfile) {
    a.Field("profile", m.profile,
            "Rows [t_s, v_m_s, yaw_rate_rad_s], each held until the next; times rise",
            Between(-1e5, 1e5));
  }
}

template <class Archive>
void Describe(Archive& a, sim::ActualConfig& c) {
  a.Field("wheel_radius_scale", c.wheel_radius_scale, "Left and right wheels, factor on the radius",
          Between(0.5, 2));
  a.Field("track_scale", c.track_scale, "Factor on the distance of left and right wheels",
          Between(0.5, 2));
  a.Field("mass_scale", c.mass_scale, "Factor on the base link's mass", Between(0.1, 10));
  a.Field("com_offset_m", c.com_offset_m, "Shift of the base link's centre of mass, body axes",
          Between(-1, 1));
  a.Field("imu_offset_m", c.imu_offset_m, "Shift of every IMU's origin, body axes", Between(-1, 1));
  a.Field("imu_rotation_deg", c.imu_rotation_deg,
          "Rotation vector by which every IMU is turned, body axes", Between(-180, 180));
}

template <class Archive>
void Describe(Archive& a, sim::SkidSteerConfig& d) {
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

}  // namespace reckon::harness
