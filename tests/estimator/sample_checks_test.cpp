#include "reckon/estimator/sample_checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "estimator/robot.h"

namespace reckon::estimator {
namespace {

using models::ContactSample;
using models::DepthSample;
using models::PoseSample;
using models::SensorKind;
using testing_estimator::kMs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is wrong with a sample of the only sensor of a robot.
Refusal Wrong(SensorKind kind, const models::Sample& sample) {
  models::Suite suite;
  suite.sensors = {{"it", kind, {}, 100 * kMs}};
  return WhatIsWrong({0, kMs, 2 * kMs, sample}, suite);
}

Refusal Depth(double depth_m) { return Wrong(SensorKind::kDepth, DepthSample{depth_m}); }

TEST(SampleChecks, Depth) {
  EXPECT_EQ(Depth(0.0), Refusal::kNone);
  EXPECT_EQ(Depth(-3.0), Refusal::kNone);  // above the water
  EXPECT_EQ(Depth(11e3), Refusal::kNone);
  for (const double bad : {kNan, kInfinity, -kInfinity}) EXPECT_EQ(Depth(bad), Refusal::kNotFinite);
  EXPECT_EQ(Depth(1e300), Refusal::kInvalid);  // its square would not be finite
}

PoseSample GoodPose() {
  PoseSample pose;
  pose.X_WS = {Exp({0.3, -2.0, 1.0}), {100.0, -200.0, 3.0}};
  pose.position_sigma_m = {1.0, 1.0, 2.0};
  pose.orientation_sigma_rad = {0.01, 0.01, 0.1};
  return pose;
}

/// What is wrong with a good pose after `spoil`.
template <typename Spoil>
Refusal Spoilt(const Spoil& spoil) {
  PoseSample pose = GoodPose();
  spoil(pose);
  return Wrong(SensorKind::kPose, pose);
}

TEST(SampleChecks, PositionOfAPose) {
  EXPECT_EQ(Spoilt([](PoseSample&) {}), Refusal::kNone);
  for (const double bad : {kNan, kInfinity}) {
    EXPECT_EQ(Spoilt([&](PoseSample& s) { s.X_WS.p.y() = bad; }), Refusal::kNotFinite);
    EXPECT_EQ(Spoilt([&](PoseSample& s) { s.position_sigma_m.z() = bad; }), Refusal::kNotFinite);
  }
  EXPECT_EQ(Spoilt([](PoseSample& s) { s.X_WS.p.x() = 1e300; }), Refusal::kInvalid);
  for (const double bad : {0.0, -1.0, 1e300}) {
    EXPECT_EQ(Spoilt([&](PoseSample& s) { s.position_sigma_m.x() = bad; }), Refusal::kInvalid);
  }
}

TEST(SampleChecks, OrientationOfAPose) {
  EXPECT_EQ(Spoilt([](PoseSample& s) { s.X_WS.R(1, 2) = kNan; }), Refusal::kNotFinite);
  EXPECT_EQ(Spoilt([](PoseSample& s) { s.orientation_sigma_rad.x() = kNan; }), Refusal::kNotFinite);
  EXPECT_EQ(Spoilt([](PoseSample& s) { s.X_WS.R *= 1.01; }), Refusal::kInvalid);
  EXPECT_EQ(Spoilt([](PoseSample& s) { s.X_WS.R.col(0) *= -1.0; }), Refusal::kInvalid);  // mirrored
  for (const double bad : {0.0, -1.0, 1e300}) {
    EXPECT_EQ(Spoilt([&](PoseSample& s) { s.orientation_sigma_rad.z() = bad; }), Refusal::kInvalid);
  }
}

TEST(SampleChecks, APositionAloneNeedsNoOrientation) {
  const auto spoilt = [](bool has_orientation) {
    return Spoilt([&](PoseSample& s) {
      s.has_orientation = has_orientation;
      s.X_WS.R.setConstant(kNan);
      s.orientation_sigma_rad.setZero();
    });
  };
  EXPECT_EQ(spoilt(false), Refusal::kNone);
  EXPECT_EQ(spoilt(true), Refusal::kNotFinite);  // control
  EXPECT_EQ(Spoilt([](PoseSample& s) {
              s.has_orientation = false;
              s.position_sigma_m.setZero();
            }),
            Refusal::kInvalid);
}

Refusal Contacts(std::initializer_list<double> probabilities) {
  ContactSample sample;
  sample.probability.resize(static_cast<Eigen::Index>(probabilities.size()));
  std::copy(probabilities.begin(), probabilities.end(), sample.probability.begin());
  return Wrong(SensorKind::kContacts, sample);
}

TEST(SampleChecks, Contacts) {
  EXPECT_EQ(Contacts({0.0, 1.0, 0.5, 1.0}), Refusal::kNone);
  EXPECT_EQ(Contacts({1.0}), Refusal::kNone);
  EXPECT_EQ(Contacts({}), Refusal::kInvalid);
  EXPECT_EQ(Contacts({0.5, -0.1}), Refusal::kInvalid);
  EXPECT_EQ(Contacts({1.1, 0.5}), Refusal::kInvalid);
  EXPECT_EQ(Contacts({0.5, kNan}), Refusal::kNotFinite);
  EXPECT_EQ(Contacts({kInfinity, 0.5}), Refusal::kNotFinite);
}

TEST(SampleChecks, OfAnotherKindThanTheSensor) {
  EXPECT_EQ(Wrong(SensorKind::kDepth, GoodPose()), Refusal::kInvalid);
  EXPECT_EQ(Wrong(SensorKind::kPose, DepthSample{1.0}), Refusal::kInvalid);
  EXPECT_EQ(Wrong(SensorKind::kContacts, DepthSample{1.0}), Refusal::kInvalid);
}

}  // namespace
}  // namespace reckon::estimator
