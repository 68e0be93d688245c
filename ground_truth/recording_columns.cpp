#include "reckon/ground_truth/recording_columns.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/report.h"

namespace reckon::ground_truth {
namespace {

using Type = ColumnType;

void Add(Columns& columns, std::string name, Type type, std::string unit, std::string text) {
  columns.push_back({std::move(name), type, std::move(unit), "", std::move(text)});
}

/// `<name>_x_<suffix>`, … : a vector's three columns.
void AddVector(Columns& columns, const std::string& name, const std::string& suffix,
               const std::string& unit, const std::string& frame, const std::string& text) {
  for (const char axis : {'x', 'y', 'z'}) {
    columns.push_back(
        {fmt::format("{}_{}_{}", name, axis, suffix), Type::kFloat64, unit, frame, text});
  }
}

/// `<name>_xx<suffix>`, … : a matrix row by row.
void AddMatrix(Columns& columns, const std::string& name, const std::string& suffix,
               const std::string& unit, const std::string& frame, const std::string& text) {
  for (const char row : {'x', 'y', 'z'}) {
    for (const char column : {'x', 'y', 'z'}) {
      columns.push_back(
          {fmt::format("{}_{}{}{}", name, row, column, suffix), Type::kFloat64, unit, frame, text});
    }
  }
}

void AddTime(Columns& columns, const std::string& name, const std::string& text) {
  Add(columns, name, Type::kInt64, "ns", text + ", since the run's start");
}

void AddPose(Columns& columns) {
  AddMatrix(columns, "R_WB", "", "1", "W", "rotation that takes coordinates in B to W");
  AddVector(columns, "p_WB", "m", "m", "W", "position of the body");
  AddVector(columns, "v_WB", "m_s", "m/s", "W", "velocity of the body");
}

void AddBiases(Columns& columns) {
  AddVector(columns, "gyro_bias", "rad_s", "rad/s", "B", "gyroscope bias in the body's axes");
  AddVector(columns, "accel_bias", "m_s2", "m/s^2", "B", "accelerometer bias in the body's axes");
}

void AddRate(Columns& columns) {
  AddVector(columns, "w_WB_B", "rad_s", "rad/s", "B", "angular velocity of the body in W");
}

void AddImu(Columns& columns) {
  AddVector(columns, "gyro", "rad_s", "rad/s", "S", "mean angular velocity over the interval");
  AddVector(columns, "accel", "m_s2", "m/s^2", "S", "mean specific force over the interval");
  Add(columns, "interval_ns", Type::kInt64, "ns", "the sample covers (valid - interval, valid]");
  Add(columns, "gyro_saturated", Type::kUint8, "1", "an axis was clipped");
  Add(columns, "accel_saturated", Type::kUint8, "1", "an axis was clipped");
}

void AddEncoders(Columns& columns, const std::vector<std::string>& channels) {
  for (const auto& channel : channels) {
    Add(columns, channel + "_angle_rad", Type::kFloat64, "rad", "accumulated angle");
  }
  for (const auto& channel : channels) {
    Add(columns, channel + "_rate_rad_s", Type::kFloat64, "rad/s", "mean rate over the interval");
  }
  Add(columns, "interval_ns", Type::kInt64, "ns", "the rates cover (valid - interval, valid]");
}

void AddBodyVelocity(Columns& columns) {
  AddVector(columns, "v_WS_S", "m_s", "m/s", "S", "velocity of the sensor's origin in W");
  AddMatrix(columns, "covariance", "_m2_s2", "m^2/s^2", "S", "as delivered by the sensor");
  Add(columns, "valid", Type::kUint8, "1", "0: the sensor has lost what it measures");
  Add(columns, "over_ground", Type::kUint8, "1", "0: relative to the water around the sensor");
  Add(columns, "figure_of_merit_m_s", Type::kFloat64, "m/s", "how its beams contradict each other");
  Add(columns, "beams", Type::kUint8, "1", "bit i: beam i had an answer");
}

void AddDepth(Columns& columns) {
  Add(columns, "depth_m", Type::kFloat64, "m", "of the sensor's origin below z = 0 of W");
}

void AddPoseSample(Columns& columns) {
  AddMatrix(columns, "R_WS", "", "1", "W", "rotation that takes coordinates in S to W");
  AddVector(columns, "p_WS", "m", "m", "W", "position of the sensor's origin");
  AddVector(columns, "position_sigma", "m", "m", "W", "as delivered by the sensor");
  AddVector(columns, "orientation_sigma", "rad", "rad", "W", "as delivered by the sensor");
  Add(columns, "has_orientation", Type::kUint8, "1", "0: R_WS and its sigma say nothing");
}

void AddChannels(Columns& columns, const std::vector<std::string>& channels, const char* suffix,
                 const char* unit, const char* meaning) {
  for (const auto& channel : channels) {
    Add(columns, channel + suffix, Type::kFloat64, unit, meaning);
  }
}

constexpr std::array<std::string_view, models::kSensorKinds> kSensorKinds{
    "imu", "encoders", "body_velocity", "depth", "pose", "contacts", "torques", "foot_forces"};
constexpr std::array<std::string_view, 3> kErrorForms{"right_invariant", "left_invariant",
                                                      "multiplicative"};
constexpr std::array<std::string_view, 6> kDecisions{"accepted", "warned",  "inflated",
                                                     "rejected", "refused", "widened"};
constexpr std::array<std::string_view, estimator::kRefusals> kRefusalWords{
    "none",        "not_finite", "not_initialised", "moving", "backwards", "late",
    "from_future", "gap",        "invalid",         "unused", "duplicate", "no_lock"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kConventions{{
    {"format", "reckon recording 1"},
    {"frames",
     "W: world, z up. B: body, x forward, y left, z up. S: the sensor's own frame. "
     "p_WB: position of B in W; R_WB takes coordinates in B to W; R_WB_xy is its entry "
     "in row x, column y"},
    {"time", "integer nanoseconds since the run's start"},
    {"error_order", "orientation, velocity, position, gyro bias, accel bias; three each"},
    {"error_right_invariant",
     "theta = Log(Rh R^T), xi_v = J^-1(theta) (vh - Rh R^T v), likewise p; "
     "biases bh - b (h: estimate, J: left Jacobian of SO(3))"},
    {"error_left_invariant",
     "theta = Log(R^T Rh), xi_v = J^-1(theta) R^T (vh - v), likewise p; "
     "biases bh - b"},
    {"error_multiplicative", "theta = Log(R^T Rh), vh - v and ph - p in W; biases bh - b"},
    {"innovation",
     "z, its covariance S and NIS = z^T S^-1 z before the gate changed them; the first "
     "`rows` entries count"},
}};

}  // namespace

Columns TruthColumns(const std::vector<std::string>& wheels, const std::vector<std::string>& feet) {
  Columns columns;
  AddTime(columns, "t_ns", "the instant");
  AddPose(columns);
  AddRate(columns);
  AddBiases(columns);
  for (const auto& wheel : wheels) {
    Add(columns, wheel + "_rate_rad_s", Type::kFloat64, "rad/s", "true spin of the wheel");
    Add(columns, wheel + "_slip_m_s", Type::kFloat64, "m/s", "contact point over the ground");
    Add(columns, wheel + "_load_n", Type::kFloat64, "N", "normal force");
  }
  for (const auto& foot : feet) {
    Add(columns, foot + "_contact", Type::kUint8, "1", "whether it presses on the ground");
    Add(columns, foot + "_normal_n", Type::kFloat64, "N", "normal force");
    Add(columns, foot + "_tangential_n", Type::kFloat64, "N", "tangential force");
    Add(columns, foot + "_slip_m_s", Type::kFloat64, "m/s", "contact point over the ground");
    Add(columns, foot + "_centre_m_s", Type::kFloat64, "m/s", "speed of the foot's origin");
    AddVector(columns, foot + "_normal", "1", "1", "W", "normal of the ground under it");
  }
  return columns;
}

Columns MeasurementColumns(const RecordedSensor& sensor) {
  Columns columns;
  Add(columns, "order", Type::kUint64, "1", "place among the measurements of all sensors");
  AddTime(columns, "valid_ns", "when the sample was true");
  AddTime(columns, "arrival_ns", "when it reached the estimators");
  switch (sensor.sensor.kind) {
    case models::SensorKind::kImu:
      AddImu(columns);
      break;
    case models::SensorKind::kEncoders:
      AddEncoders(columns, sensor.channels);
      break;
    case models::SensorKind::kBodyVelocity:
      AddBodyVelocity(columns);
      break;
    case models::SensorKind::kDepth:
      AddDepth(columns);
      break;
    case models::SensorKind::kPose:
      AddPoseSample(columns);
      break;
    case models::SensorKind::kContacts:
      AddChannels(columns, sensor.channels, "_contact", "1", "probability that the foot stands");
      break;
    case models::SensorKind::kTorques:
      AddChannels(columns, sensor.channels, "_n_m", "N m", "torque of the joint's motor");
      break;
    case models::SensorKind::kFootForces:
      AddChannels(columns, sensor.channels, "_n", "N", "force that presses the foot");
      break;
  }
  return columns;
}

Columns EstimateColumns(const std::vector<std::string>& feet) {
  Columns columns;
  AddTime(columns, "t_ns", "the instant that is estimated");
  AddPose(columns);
  AddBiases(columns);
  Add(columns, "covariance_row", Type::kInt64, "1", "its row in ../covariance; -1: not recorded");
  Add(columns, "error_form", Type::kUint8, "1", "see error_form_names");
  Add(columns, "has_covariance", Type::kUint8, "1", "whether the estimator has a covariance");
  Add(columns, "has_biases", Type::kUint8, "1", "whether the estimator estimates biases");
  AddChannels(columns, feet, "_contact", "1",
              "probability that the foot stands, as used; NaN: the estimator does not say");
  return columns;
}

Columns CorrectionColumns() {
  Columns columns;
  AddTime(columns, "t_ns", "when the measurement was true");
  Add(columns, "measurement", Type::kUint64, "1",
      "the measurement's `order`; 2^64 - 1: not among the sensor's newest");
  Add(columns, "sensor", Type::kUint16, "1", "see sensor_names");
  Add(columns, "decision", Type::kUint8, "1", "see decision_names");
  Add(columns, "reason", Type::kUint8, "1", "see refusal_names");
  Add(columns, "rows", Type::kUint8, "1", "how many rows the innovation has");
  for (const char* row : {"0", "1", "2"}) {
    Add(columns, std::string("z_") + row, Type::kFloat64, "of the row", "innovation");
  }
  for (const char* entry : {"00", "01", "02", "11", "12", "22"}) {
    Add(columns, std::string("S_") + entry, Type::kFloat64, "of the rows",
        "covariance of the innovation");
  }
  Add(columns, "nis", Type::kFloat64, "1", "normalised innovation squared");
  return columns;
}

Columns RefusalColumns() {
  Columns columns;
  AddTime(columns, "valid_ns", "when the sample was true");
  AddTime(columns, "arrival_ns", "when it reached the estimator");
  Add(columns, "measurement", Type::kUint64, "1", "the measurement's `order`");
  Add(columns, "sensor", Type::kUint16, "1", "see sensor_names");
  Add(columns, "reason", Type::kUint8, "1", "see refusal_names");
  return columns;
}

Columns PriorColumns() {
  Columns columns;
  AddTime(columns, "t_ns", "the instant of the prior");
  AddPose(columns);
  AddRate(columns);
  AddBiases(columns);
  return columns;
}

std::span<const std::string_view> SensorKindNames() { return kSensorKinds; }
std::span<const std::string_view> ErrorFormNames() { return kErrorForms; }
std::span<const std::string_view> DecisionNames() { return kDecisions; }
std::span<const std::string_view> RefusalNames() { return kRefusalWords; }

const std::vector<std::string>& ErrorNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const char* block : {"theta", "velocity", "position", "gyro_bias", "accel_bias"}) {
      for (const char axis : {'x', 'y', 'z'}) all.push_back(std::string(block) + "_" + axis);
    }
    return all;
  }();
  return names;
}

std::span<const std::pair<std::string_view, std::string_view>> Conventions() {
  return kConventions;
}

}  // namespace reckon::ground_truth
