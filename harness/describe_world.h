#pragma once

#include "reckon/harness/describe_terrain.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, sim::GaitConfig& g) {
  using Gait = sim::GaitConfig;
  a.Field("kind", g.kind, "Which feet go together");
  a.Field("period_s", g.period_s, "Of a stride; not given: the gait's own", Within(Gait::kPeriod));
  a.Field("duty", g.duty, "Share of a stride that a foot is down; likewise", Within(Gait::kDuty));
  a.Field("offsets", g.offsets, "Phase of each foot, in strides; likewise", Within(Gait::kOffset));
  a.Field("lift_m", g.lift_m, "How high a foot swings; likewise", Within(Gait::kLift));
}

template <class Archive>
void Describe(Archive& a, sim::ControlConfig& c) {
  a.Field("gait", c.gait, "When which foot is down");
  a.Field("in_air", c.in_air, "Hung up by its trunk: it walks without touching anything");
}

template <class Archive>
void Describe(Archive& a, sim::PushConfig& p) {
  a.Field("impulse_n_s", p.impulse_n_s, "Of one push, level and in a random direction",
          Within(sim::PushConfig::kImpulse));
  a.Field("every_s", p.every_s, "From push to push", Within(sim::PushConfig::kEvery));
  a.Field("for_s", p.for_s, "How long one lasts", Within(sim::PushConfig::kFor));
}

template <class Archive>
void Describe(Archive& a, sim::CurrentConfig& c) {
  a.Field("mean_m_s", c.mean_m_s, "Mean velocity of the water, world axes",
          Within(sim::CurrentConfig::kSpeed));
  a.Field("sigma_m_s", c.sigma_m_s,
          "Standard deviation of each axis of a first-order Gauss-Markov process on top",
          Within(sim::CurrentConfig::kSigma));
  a.Field("time_constant_s", c.time_constant_s, "Its time constant",
          Within(sim::CurrentConfig::kTimeConstant));
}

template <class Archive>
void Describe(Archive& a, sim::FeatureConfig& f) {
  a.Field("kind", f.kind, "What it is", {}, Need::kHere);
  a.Field("at_m", f.at_m, "Its middle, [x, y]", Within(sim::FeatureConfig::kAt), Need::kHere);
  a.Field("size_m", f.size_m, "Along its own x, its y and up", Within(sim::FeatureConfig::kSize));
  a.Field("yaw_deg", f.yaw_deg, "Direction of its own x", Within(sim::FeatureConfig::kYaw));
}

template <class Archive>
void Describe(Archive& a, sim::WaterConfig& w) {
  using Water = sim::WaterConfig;
  a.Field("density_kg_m3", w.density_kg_m3, "Of the water", Within(Water::kDensity));
  a.Field("sound_speed_m_s", w.sound_speed_m_s, "In the water", Within(Water::kSoundSpeed));
  a.Field("depth_m", w.depth_m, "Of the bottom under x = y = 0 (of a rough one: on the mean)",
          Within(Water::kDepth));
  a.Field("current", w.current, "How the water flows");
  a.Field("features", w.features, "What lies on the bottom");
}

/// The `world:` section; motion and actual robot are sections of their own.
template <class Archive>
void Describe(Archive& a, sim::WorldConfig& w) {
  a.Field("physics_step_s", w.physics_step_s, "Step of the physics, a whole number of nanoseconds",
          Within(sim::WorldConfig::kPhysicsStep));
  a.Field("gravity_m_s2", w.gravity_m_s2, "Gravity, downwards", Within(sim::WorldConfig::kGravity));
  a.Field("settle_s", w.settle_s, "Time in which the robot comes to rest before t = 0",
          Within(sim::WorldConfig::kSettle));
  a.Field("terrain", w.terrain, "The ground, or the form of the seabed");
  a.Field("patches", w.patches, "Rectangles with another friction; later ones win");
  a.Field("pushes", w.pushes, "Impulses on the body of a robot on legs");
  a.Field("water", w.water, "The sea, of an underwater vehicle; its surface is z = 0");
}

template <class Archive>
void Describe(Archive& a, sim::MotionConfig& m) {
  using Kind = sim::PathKind;
  a.Kind("path", m.path, Choices<Kind>(), "What the driver is asked to do");
  if (m.path != Kind::kStand) {
    a.Field("start_s", m.start_s, "The robot stands still until then", Between(0, 1e5));
  }
  if (m.path != Kind::kStand) {
    a.Field("go_s", m.go_s, "Stands still for `stop_s` after each `go_s` of going; 0: never",
            Between(0, 1e5));
    a.Field("stop_s", m.stop_s, "Likewise", Between(0, 1e5));
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

/// Of an underwater vehicle.
template <class Archive>
void Describe(Archive& a, sim::MissionConfig& m) {
  using Kind = sim::MissionKind;
  using Mission = sim::MissionConfig;
  a.Kind("kind", m.kind, Choices<Kind>(), "What the vehicle is asked to do");
  a.Field("start_s", m.start_s, "It holds its place until then", Within(Mission::kTime));
  a.Field("start_depth_m", m.start_depth_m, "How deep it starts");
  a.Field("depth_m", m.depth_m, "Where it goes down to first, under x = y = 0");
  a.Field("speed_m_s", m.speed_m_s, "Over ground", Within(Mission::kSpeed));
  if (m.kind == Kind::kDive) {
    a.Field("hold_s", m.hold_s, "Time at depth", Within(Mission::kTime));
  }
  if (m.kind == Kind::kSquare) {
    a.Field("side_m", m.side_m, "Side of the square", Within(Mission::kLength));
    a.Field("laps", m.laps, "Laps, then it stops", Within(Mission::kLaps));
  }
  if (m.kind == Kind::kLawnmower) {
    a.Field("length_m", m.length_m, "Of a track, along x", Within(Mission::kLength));
    a.Field("spacing_m", m.spacing_m, "From track to track, along y", Within(Mission::kLength));
    a.Field("tracks", m.tracks, "How many, then it stops", Within(Mission::kTracks));
  }
  if (m.kind == Kind::kHelix) {
    a.Field("radius_m", m.radius_m, "Of a circle", Within(Mission::kLength));
    a.Field("turns", m.turns, "Circles, then it stops", Within(Mission::kLaps));
    a.Field("end_depth_m", m.end_depth_m, "Depth of its last point");
  }
  if (m.kind == Kind::kSquare || m.kind == Kind::kLawnmower || m.kind == Kind::kHelix) {
    a.Field("clockwise", m.clockwise, "To the right, seen from above");
  }
  if (m.kind == Kind::kWaypoints) {
    a.Field("waypoints_m", m.waypoints_m, "Points [x, y, depth], stopping at the last",
            Between(-1e4, 1e4), Need::kHere);
  }
}

template <class Archive>
void Describe(Archive& a, sim::ActualConfig& c) {
  a.Field("wheel_radius_scale", c.wheel_radius_scale, "Left and right wheels, factor on the radius",
          Between(0.5, 2));
  a.Field("track_scale", c.track_scale, "Factor on the distance of left and right wheels",
          Between(0.5, 2));
  a.Field("leg_offset_m", c.leg_offset_m,
          "How much longer each segment of every leg is, from the body outwards", Between(-1, 1));
  a.Field("foot_radius_offset_m", c.foot_radius_offset_m, "How much larger the feet are",
          Between(-0.5, 0.5));
  a.Field("encoder_offset_rad", c.encoder_offset_rad, "What a joint's encoder reads too much",
          Between(-3.2, 3.2));
  a.Field("mass_scale", c.mass_scale, "Factor on the base link's mass", Between(0.1, 10));
  a.Field("com_offset_m", c.com_offset_m, "Shift of the base link's centre of mass, body axes",
          Between(-1, 1));
  a.Field("imu_offset_m", c.imu_offset_m, "Shift of every IMU's origin, body axes", Between(-1, 1));
  a.Field("imu_rotation_deg", c.imu_rotation_deg,
          "Rotation vector by which every IMU is turned, body axes", Between(-180, 180));
}

}  // namespace reckon::harness
