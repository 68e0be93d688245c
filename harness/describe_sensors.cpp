#include "reckon/harness/describe_sensors.h"

#include "reckon/sim/dvl_grades.h"
#include "reckon/sim/faults.h"
#include "reckon/sim/imu_grades.h"

namespace reckon::harness {

void ApplyGrade(sim::ImuConfig& imu) {
  if (const sim::ImuGrade* grade = sim::FindImuGrade(imu.grade)) {
    imu.gyro = grade->gyro;
    imu.accel = grade->accel;
  }
}

void ApplyGrade(sim::DvlConfig& dvl) {
  if (const sim::DvlGrade* grade = sim::FindDvlGrade(dvl.grade)) dvl = grade->config;
}

const std::vector<Choice<std::string>>& DvlGrades() {
  static const std::vector<Choice<std::string>> kGrades = [] {
    std::vector<Choice<std::string>> grades;
    for (const sim::DvlGrade& grade : sim::DvlGrades()) {
      grades.push_back(
          {std::string(grade.name), std::string(grade.name), std::string(grade.source)});
    }
    return grades;
  }();
  return kGrades;
}

const std::vector<Choice<std::string>>& ImuGrades() {
  static const std::vector<Choice<std::string>> kGrades = [] {
    std::vector<Choice<std::string>> grades;
    for (const sim::ImuGrade& grade : sim::ImuGrades()) {
      for (const std::string_view name : {grade.name, grade.alias}) {
        if (name.empty()) continue;
        grades.push_back({std::string(name), std::string(name), std::string(grade.source)});
      }
    }
    return grades;
  }();
  return kGrades;
}

template <>
std::span<const Choice<sim::FaultChannels>> Choices() {
  static const std::vector<Choice<sim::FaultChannels>> kChoices = [] {
    std::vector<Choice<sim::FaultChannels>> choices;
    const auto add = [&](sim::FaultChannels channels, const char* doc) {
      choices.push_back({channels, std::string(sim::FaultChannelsName(channels)), doc});
    };
    add(sim::FaultChannels::kAll, "all that the sensor measures");
    add(sim::FaultChannels::kGyro, "the angular velocity of an IMU");
    add(sim::FaultChannels::kAccel, "the specific force of an IMU");
    add(sim::FaultChannels::kAngle, "the angles of encoders");
    add(sim::FaultChannels::kRate, "the rates of encoders");
    return choices;
  }();
  return kChoices;
}

sim::SensorErrors DefaultErrors(sim::SensorType type) {
  switch (type) {
    case sim::SensorType::kImu:
      return sim::ImuConfig{};
    case sim::SensorType::kEncoders:
      return sim::EncoderConfig{};
    case sim::SensorType::kBodyVelocity:
      return sim::BodyVelocityConfig{};
    case sim::SensorType::kDepth:
      return sim::DepthConfig{};
    case sim::SensorType::kPose:
      return sim::PoseConfig{};
    case sim::SensorType::kDvl:
      return sim::DvlConfig{};
    case sim::SensorType::kContacts:
      return sim::ContactSensorConfig{};
    case sim::SensorType::kTorques:
      return sim::TorqueConfig{};
    case sim::SensorType::kFootForces:
      return sim::FootForceConfig{};
  }
  return sim::ImuConfig{};
}

}  // namespace reckon::harness
