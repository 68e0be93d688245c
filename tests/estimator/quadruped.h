#pragma once

#include <string>
#include <vector>

#include "estimator/robot.h"

namespace reckon::testing_estimator {

inline constexpr models::SensorId kJoints = 1, kContacts = 2, kLegVelocity = 3;

/// One leg of a hip and a knee at (x, y) of the body, both about the y axis; thigh 0.3 m, shank
/// 0.4 m.
inline std::string LegText(const std::string& name, double x, double y) {
  const std::string limits = R"(<limit lower="-3" upper="3" effort="1" velocity="1"/>)";
  const std::string axis = R"(<axis xyz="0 1 0"/>)";
  const auto link = [&](const std::string& part) { return "<link name=\"" + name + part + "\"/>"; };
  const auto joint = [&](const std::string& part, const std::string& kind,
                         const std::string& parent, const std::string& child,
                         const std::string& xyz) {
    return "<joint name=\"" + name + part + "\" type=\"" + kind + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + name + child + "\"/><origin xyz=\"" + xyz + "\"/>" +
           (kind == "fixed" ? "" : axis + limits) + "</joint>";
  };
  return link("_thigh") + link("_shank") + link("_foot") +
         joint("_hip", "revolute", "base", "_thigh",
               std::to_string(x) + " " + std::to_string(y) + " 0") +
         joint("_knee", "revolute", name + "_thigh", "_shank", "0 0 -0.3") +
         joint("_toe", "fixed", name + "_shank", "_foot", "0 0 -0.4");
}

/// A quadruped with a leg at each corner: IMU, joint encoders, contacts, a velocity sensor.
inline estimator::Setup QuadrupedSetup() {
  estimator::Setup setup = TestSetup();
  const models::Pose X_BV = setup.suite.sensors[kVelocity].X_BS;
  setup.suite.wheels.reset();
  setup.suite.sensors.resize(1);
  setup.suite.sensors.push_back({"joints", models::SensorKind::kEncoders, {}, 5 * kMs});
  setup.suite.sensors.push_back({"contacts", models::SensorKind::kContacts, {}, 5 * kMs});
  setup.suite.sensors.push_back({"velocity", models::SensorKind::kBodyVelocity, X_BV, 50 * kMs});
  const std::vector<std::string> names{"lf", "rf", "lh", "rh"};
  const double x[] = {0.3, 0.3, -0.3, -0.3}, y[] = {0.2, -0.2, 0.2, -0.2};
  std::string text = R"(<robot name="four"><link name="base"/>)";
  std::vector<std::string> joints;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += LegText(names[i], x[i], y[i]);
    joints.push_back(names[i] + "_hip");
    joints.push_back(names[i] + "_knee");
  }
  const auto robot = models::UrdfRobot::FromText(text + "</robot>");
  models::LegSet legs{"joints", "contacts", {}, 0.0};
  for (const std::string& name : names) legs.legs.emplace_back(robot, name + "_foot", joints);
  setup.suite.legs = legs;
  setup.noise.joint_angle_rad = 2e-3;
  setup.noise.foot_position_m = 2e-3;
  setup.noise.foot_slip_m_per_s_sqrt_hz = 1e-2;
  return setup;
}

/// The eight joint angles, hip and knee of each leg.
inline Measurement JointsAt(TimeNs t, const models::EncoderVector& angles) {
  models::EncoderSample sample;
  sample.angle_rad = angles;
  sample.rate_rad_s = models::EncoderVector::Zero(angles.size());
  sample.interval_ns = 5 * kMs;
  return {kJoints, t, t, sample};
}

inline models::EncoderVector Stance() {
  models::EncoderVector angles(8);
  angles << 0.4, -0.8, 0.3, -0.7, 0.4, -0.8, 0.3, -0.7;
  return angles;
}

/// Which of the four feet stand.
inline Measurement ContactsAt(TimeNs t, bool lf, bool rf, bool lh, bool rh) {
  models::ContactSample sample;
  sample.probability.resize(4);
  sample.probability << lf, rf, lh, rh;
  return {kContacts, t, t, sample};
}

}  // namespace reckon::testing_estimator
