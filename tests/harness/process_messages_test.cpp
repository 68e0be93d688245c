#include "reckon/harness/process_messages.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace reckon::harness {
namespace {

using nlohmann::json;

json Message(const models::Sample& sample) {
  return json::parse(MeasurementMessage({3, 10, 12, sample}));
}

TEST(ProcessMessages, Depth) {
  const json message = Message(models::DepthSample{1.0 / 3.0});
  EXPECT_EQ(message, json({{"message", "depth"},
                           {"sensor", 3},
                           {"valid_ns", 10},
                           {"arrival_ns", 12},
                           {"depth_m", 1.0 / 3.0}}));  // to the last bit
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Message(models::DepthSample{nan}).at("depth_m"), nullptr);
}

TEST(ProcessMessages, Pose) {
  models::PoseSample pose;
  pose.X_WS.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // a quarter turn to the left
  pose.X_WS.p = {1, 2, 3};
  pose.position_sigma_m = {0.1, 0.2, 0.3};
  pose.orientation_sigma_rad = {0.4, 0.5, 0.6};
  const json message = Message(pose);
  EXPECT_EQ(message.at("message"), "pose");
  EXPECT_EQ(message.at("p_WS_m"), json({1.0, 2.0, 3.0}));
  EXPECT_EQ(message.at("position_sigma_m"), json({0.1, 0.2, 0.3}));
  EXPECT_EQ(message.at("orientation_sigma_rad"), json({0.4, 0.5, 0.6}));
  ASSERT_EQ(message.at("q_WS").size(), 4U);
  const double half = std::sqrt(0.5);
  const double expected[] = {half, 0.0, 0.0, half};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(message.at("q_WS")[i], expected[i], 1e-15);
}

TEST(ProcessMessages, PoseWithoutOrientation) {
  models::PoseSample pose;
  pose.has_orientation = false;
  const json message = Message(pose);
  EXPECT_EQ(message.at("p_WS_m").size(), 3U);
  EXPECT_EQ(message.at("q_WS"), nullptr);
  EXPECT_EQ(message.at("orientation_sigma_rad"), nullptr);
}

TEST(ProcessMessages, Contacts) {
  models::ContactSample contacts;
  contacts.probability = Eigen::Vector3d(0, 1, 0.25);
  const json message = Message(contacts);
  EXPECT_EQ(message.at("message"), "contacts");
  EXPECT_EQ(message.at("probability"), json({0.0, 1.0, 0.25}));
}

TEST(ProcessMessages, HelloTellsWhatAFilterIsTold) {
  using Kind = models::SensorKind;
  estimator::Setup setup;
  setup.suite.sensors = {{"a", Kind::kImu, {}, 1},          {"b", Kind::kEncoders, {}, 1},
                         {"c", Kind::kBodyVelocity, {}, 1}, {"d", Kind::kDepth, {}, 1},
                         {"e", Kind::kPose, {}, 1},         {"f", Kind::kContacts, {}, 1}};
  setup.initialisation.kind = estimator::InitialisationKind::kPose;
  setup.iterations = 7;
  setup.history_s = 1.5;
  setup.standstill = {true, 0.75};
  setup.floor = {true, -2.0};
  setup.gyro_filter = {"b", 0.125};
  setup.noise.depth_m = 0.5;
  const json hello = json::parse(HelloMessage("husky", setup));
  std::vector<std::string> kinds;
  for (const json& sensor : hello.at("sensors")) kinds.push_back(sensor.at("kind"));
  EXPECT_EQ(kinds, (std::vector<std::string>{"imu", "encoders", "body_velocity", "depth", "pose",
                                             "contacts"}));
  EXPECT_EQ(hello.at("initialisation").at("kind"), "pose");
  EXPECT_EQ(hello.at("iterations"), 7);
  EXPECT_EQ(hello.at("history_s"), 1.5);
  EXPECT_EQ(hello.at("standstill"), json({{"use", true}, {"window_s", 0.75}}));
  EXPECT_EQ(hello.at("floor"), json({{"use", true}, {"height_m", -2.0}}));
  EXPECT_EQ(hello.at("gyro_filter"), json({{"source", "b"}, {"bias_sigma_rad_s", 0.125}}));
  EXPECT_EQ(hello.at("noise").at("depth_m"), 0.5);
  EXPECT_EQ(hello.at("noise").size(), estimator::NoiseFields().size());
}

}  // namespace
}  // namespace reckon::harness
