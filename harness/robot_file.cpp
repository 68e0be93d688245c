#include "reckon/harness/robot_file.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reckon/harness/describe_reader.h"
#include "reckon/harness/describe_scenario.h"
#include "reckon/harness/log_file.h"
#include "reckon/harness/scenario_paths.h"
#include "reckon/harness/yaml_load.h"
#include "reckon/sim/legged_body.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, RobotFile& r) {
  a.Field("description", r.description, "A sentence for people");
  a.Field("urdf", r.urdf, "The URDF, relative to this folder", {}, Need::kHere);
  a.Field("base_link", r.base_link, "The link that is the body frame");
  a.Field("drive", r.drive, "What moves it");
  a.Field("sensors", r.sensors, "The robot's own sensors");
  a.Field("nominal", r.nominal, "The robot as estimators know it");
}

namespace {

using Names = std::vector<std::string>;

models::Pose ActualPose(const models::Pose& X_BS, const SensorConfig& sensor,
                        const sim::ActualConfig& actual) {
  if (!std::holds_alternative<sim::ImuConfig>(sensor.errors)) return X_BS;
  const Eigen::Vector3d turn = actual.imu_rotation_deg * (std::numbers::pi / 180.0);
  const double angle = turn.norm();
  models::Pose X = X_BS;
  X.p += actual.imu_offset_m;
  if (angle > 0.0) X.R = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * X_BS.R;
  return X;
}

models::TimeNs PeriodOf(const SensorConfig& sensor) {
  const auto rate = [](const auto& errors) { return errors.timing.rate_hz; };
  return std::llround(1e9 / std::visit(rate, sensor.errors));
}

/// What encoders read: the wheels, left then right, front to rear, or the joints of the legs, leg
/// by leg; nothing for a robot without.
std::vector<std::string> JointsOf(const sim::DriveConfig& drive, const models::UrdfRobot& urdf) {
  if (const auto* legged = std::get_if<sim::LeggedConfig>(&drive)) {
    return sim::LegJoints(urdf, legged->feet);
  }
  const auto* wheels = std::get_if<sim::SkidSteerConfig>(&drive);
  if (wheels == nullptr) return {};
  std::vector<std::string> joints = wheels->left_joints;
  joints.insert(joints.end(), wheels->right_joints.begin(), wheels->right_joints.end());
  return joints;
}

models::WheelDrive WheelsOf(const Scenario& scenario) {
  const NominalWheels& nominal = scenario.nominal.wheels;
  models::WheelDrive wheels;
  wheels.encoders = nominal.encoders;
  int entry = 0;
  const auto& drive = std::get<sim::SkidSteerConfig>(scenario.drive);
  for (std::size_t i = 0; i < drive.left_joints.size(); ++i) wheels.left.push_back(entry++);
  for (std::size_t i = 0; i < drive.right_joints.size(); ++i) wheels.right.push_back(entry++);
  wheels.rolling_radius_m = nominal.rolling_radius_m;
  wheels.effective_track_m = nominal.effective_track_m;
  wheels.X_BS.p = Eigen::Vector3d(nominal.origin_m[0], nominal.origin_m[1], nominal.origin_m[2]);
  return wheels;
}

models::LegSet LegsOf(const Scenario& scenario, const models::UrdfRobot& urdf,
                      const std::vector<std::string>& joints) {
  models::LegSet legs{scenario.nominal.legs.encoders,
                      scenario.nominal.legs.contacts,
                      {},
                      scenario.nominal.legs.foot_radius_m};
  const auto& legged = std::get<sim::LeggedConfig>(scenario.drive);
  for (const std::string& foot : legged.feet) {
    legs.legs.emplace_back(urdf, foot, joints);
    legs.dynamics.emplace_back(urdf, foot, joints, legged.armature_kg_m2);
  }
  return legs;
}

/// What the actual robot's encoders read too much goes with their errors.
sim::SensorErrors ActualErrors(const SensorConfig& sensor, const sim::ActualConfig& actual,
                               const std::vector<std::string>& joints) {
  sim::SensorErrors errors = sensor.errors;
  auto* encoders = std::get_if<sim::EncoderConfig>(&errors);
  if (encoders == nullptr || actual.encoder_offset_rad.empty()) return errors;
  for (const std::string& joint : joints) {
    const auto found = actual.encoder_offset_rad.find(joint);
    const bool has = found != actual.encoder_offset_rad.end();
    encoders->actual_offset_rad.push_back(has ? found->second : 0.0);
  }
  return errors;
}

Robot RobotOf(const LoadedLog& log) {
  Robot robot;
  robot.nominal = SuiteOf(log);
  for (const auto& [name, sensor] : log.values.sensors) robot.channels.push_back(sensor.channels);
  return robot;
}

}  // namespace

LoadedRobotFile LoadRobotFile(const std::string& name, const Location& where) {
  const auto folder = FindRobot(name);
  if (!folder) {
    Fail(where, "'/robot': there is no robot '" + Shown(name) + "' in models/" +
                    DidYouMean(name, RobotNames()));
  }
  LoadedRobotFile file;
  file.folder = *folder;
  file.root = LoadYamlFile(*folder / "robot.yaml");
  Problems problems;
  ReadDocument(file.root, problems, file.values);
  problems.ThrowIfAny();
  return file;
}

Robot MakeRobot(const Scenario& scenario, const models::UrdfRobot& urdf) {
  Robot robot;
  robot.simulated.name = scenario.robot;
  robot.simulated.drive = scenario.drive;
  if (const auto* legged = std::get_if<sim::LeggedConfig>(&scenario.drive)) {
    robot.feet = legged->feet;
  }
  robot.joints = JointsOf(scenario.drive, urdf);
  for (const auto& [name, sensor] : scenario.sensors) {
    const models::Pose X_BS = urdf.LinkPose(sensor.frame);
    const auto id = static_cast<models::SensorId>(robot.sensors.size());
    robot.nominal.sensors.push_back({name, sim::KindOf(sensor.errors), X_BS, PeriodOf(sensor)});
    const models::SensorKind kind = robot.nominal.sensors.back().kind;
    const int most = models::MostChannels(kind);
    robot.channels.push_back(most == models::kMaxEncoders ? robot.joints
                             : most == models::kMaxFeet   ? robot.feet
                                                          : Names());
    robot.sensors.push_back({name, id, ActualPose(X_BS, sensor, scenario.world.actual),
                             ActualErrors(sensor, scenario.world.actual, robot.joints)});
  }
  const bool has_wheels = scenario.sensors.contains(scenario.nominal.wheels.encoders);
  if (has_wheels) robot.nominal.wheels = WheelsOf(scenario);
  const bool has_legs = scenario.sensors.contains(scenario.nominal.legs.encoders);
  if (has_legs) robot.nominal.legs = LegsOf(scenario, urdf, robot.joints);
  return robot;
}

Robot LoadRobot(const Scenario& scenario) {
  if (!scenario.log.empty()) return RobotOf(LoadLog(scenario.log));
  const Location where{std::make_shared<const std::string>("robot " + scenario.robot), 0, 0};
  const LoadedRobotFile file = LoadRobotFile(scenario.robot, where);
  const std::filesystem::path urdf_path = file.folder / file.values.urdf;
  try {
    Robot robot = MakeRobot(scenario, models::UrdfRobot::FromFile(urdf_path.string()));
    robot.simulated.urdf_path = urdf_path.string();
    robot.simulated.base_link = file.values.base_link;
    return robot;
  } catch (const std::invalid_argument& error) {
    Fail(where, error.what());
  }
}

}  // namespace reckon::harness
