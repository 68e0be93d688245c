#pragma once

#include <map>
#include <optional>
#include <string>

#include "reckon/harness/comparison.h"
#include "reckon/harness/describe_drive.h"
#include "reckon/harness/describe_estimators.h"
#include "reckon/harness/describe_sensors.h"
#include "reckon/harness/describe_world.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, NominalWheels& w) {
  a.Field("encoders", w.encoders, "The sensor that reports the wheels; empty: none");
  a.Field("rolling_radius_m", w.rolling_radius_m, "Forward speed over mean wheel rate",
          Between(0, 5));
  a.Field("effective_track_m", w.effective_track_m,
          "Difference of the sides' speeds over turn rate, slip included", Between(0, 20));
  a.Field("origin_m", w.origin_m,
          "The point of the body where forward speed and the nonholonomic conditions hold",
          Between(-10, 10));
}

template <class Archive>
void Describe(Archive& a, NominalLegs& l) {
  a.Field("encoders", l.encoders, "The sensor that reports the joints; empty: no legs");
  a.Field("contacts", l.contacts, "The sensor that says which feet stand");
  a.Field("foot_radius_m", l.foot_radius_m, "Of round feet; 0: points", Between(0, 0.5));
}

template <class Archive>
void Describe(Archive& a, NominalConfig& n) {
  a.Field("wheels", n.wheels, "The drive, as a calibration finds it");
  a.Field("legs", n.legs, "The legs that contact-aided filters use");
  a.Field("noise", n.noise, "The noise of estimators with `noise: nominal`");
}

template <class Archive>
void Describe(Archive& a, ground_truth::ScoreOptions& s) {
  a.Field("align", s.align, "How an estimate is laid onto the truth before the absolute error");
  a.Field("rpe_m", s.rpe_m, "Segment lengths of the relative error, along the true path",
          AboveUpTo(0, 1e5));
  a.Field("rpe_s", s.rpe_s, "Windows of the relative error", AboveUpTo(0, 1e5));
  a.Field("start_s", s.start_s, "Nothing before this is scored", Between(0, 1e6));
}

template <class Archive>
void Describe(Archive& a, RecordConfig& r) {
  a.Field("truth", r.truth, "Write the truth");
  a.Field("measurements", r.measurements, "Write what was sent, as it was sent");
  a.Field("estimates", r.estimates, "Write the estimates");
  a.Field("covariance", r.covariance, "With their covariance");
  a.Field("innovations", r.innovations, "Write every correction");
  a.Field("truth_rate_hz", r.truth_rate_hz, "An integer fraction of the physics rate",
          AboveUpTo(0, 1e5));
  a.Field("estimate_rate_hz", r.estimate_rate_hz, "0: every estimate", Between(0, 1e5));
}

template <class Archive>
void Describe(Archive& a, Bound& b) {
  a.Field("min", b.min, "The metric must be at least this");
  a.Field("max", b.max, "The metric must be at most this");
}

/// `consistency: {false_alarm: …}`.
struct ConsistencyTest {
  double false_alarm = 1e-6;
};

template <class Archive>
void Describe(Archive& a, ConsistencyTest& c) {
  a.Field("false_alarm", c.false_alarm,
          "Probability that an honest filter fails any of these tests", AboveUpTo(0, 0.5));
}

template <class Archive>
void Describe(Archive& a, Expectation& e) {
  std::optional<ConsistencyTest> consistency;
  if (e.consistency_false_alarm) consistency = ConsistencyTest{*e.consistency_false_alarm};
  a.Field("consistency", consistency, "Test of NIS by sensor and NEES by block at fixed times");
  e.consistency_false_alarm.reset();
  if (consistency) e.consistency_false_alarm = consistency->false_alarm;
  std::map<std::string, Bound> bounds;
  for (const Bound& bound : e.bounds) bounds[bound.metric] = bound;
  a.Rest(bounds, "Bounds on a metric: `reckon list metrics`");
  e.bounds.clear();
  for (auto& [metric, bound] : bounds) {
    bound.metric = metric;
    e.bounds.push_back(bound);
  }
}

template <class Archive>
void Describe(Archive& a, ExpectConfig& e) {
  a.Field("compare", e.compare,
          "Such as `riekf.ate_position_rmse_m < 0.8 * mekf.ate_position_rmse_m`");
  a.Field("exit_code", e.exit_code, "For a run that must fail", Between(0, 3));
  a.Rest(e.estimators, "What is expected of one estimator");
}

/// What a scenario without a log has.
template <class Archive>
void DescribeSimulation(Archive& a, Scenario& s) {
  a.Field("recording", s.recording,
          "A recording of this scenario, relative to this file: its measurements stand in for the "
          "simulator's");
  a.Field("robot", s.robot, "A folder in models/");
  a.Field("duration_s", s.duration_s, "Simulated time", AboveUpTo(0, 1e5));
  a.Field("drive", s.drive, "Truth: what moves the robot");
  a.Field("world", s.world, "Truth: the ground, the water and the physics");
  const bool walks = sim::KindOf(s.drive) == sim::DriveKind::kLegged;
  if (Archive::kListsAll || walks) {
    a.Field("control", s.world.control, "Truth: how a robot on legs walks");
  }
  const bool swims = sim::KindOf(s.drive) == sim::DriveKind::kUnderwater;
  if (Archive::kListsAll || !swims) {
    a.Field("motion", s.world.motion, "Truth: what a robot on wheels or legs is asked to do");
  }
  if (Archive::kListsAll || swims) {
    a.Field("mission", s.world.mission, "Truth: what an underwater vehicle does");
  }
  // The others are refused with a sentence of their own.
  if (!Archive::kListsAll) a.Directive(swims ? "motion" : "mission", "");
  if (!Archive::kListsAll && !walks) a.Directive("control", "");
  a.Field("actual", s.world.actual, "Truth: how the simulated robot differs from the nominal one");
  a.Removable("sensors", s.sensors,
              "Truth: what the sensors send; `off` removes one of the robot's");
  a.Field("faults", s.faults, "Truth: what goes wrong with a sensor, and when");
}

template <class Archive>
void Describe(Archive& a, Scenario& s) {
  a.Field("schema", s.schema, "Version of this format", Between(1, 1));
  a.Field("description", s.description, "A sentence for people");
  a.Directive("include", "Files that this one is laid over, relative to it; the last one wins");
  bool robot_defaults = !Archive::kWrites;  // a resolved file holds everything that it needs
  a.Field("robot_defaults", robot_defaults,
          "Start from the robot's own sensors, drive and nominal values");
  a.Field("log", s.log,
          "A folder with a robot's log, relative to this file: it stands in for the simulator");
  a.Field("seed", s.seed, "Of every random draw", AtLeast(0));
  if (s.log.empty()) DescribeSimulation(a, s);
  a.Field("nominal", s.nominal, "Belief: the robot as estimators know it");
  a.Field("initial", s.initial, "Belief: where all estimators start");
  EstimatorConfig prototype;
  prototype.noise = s.nominal.noise;
  a.Map("estimators", s.estimators, prototype, "Belief: the estimators under test");
  a.Field("score", s.score, "How estimates are scored");
  a.Field("record", s.record, "What is written, and how often");
  a.Field("expect", s.expect, "What a run must reach; a failure is exit code 1");
}

}  // namespace reckon::harness
