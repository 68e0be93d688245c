#include "reckon/harness/log_file.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reckon/harness/describe_reader.h"
#include "reckon/harness/describe_scenario.h"
#include "reckon/harness/nearest.h"
#include "reckon/harness/yaml_load.h"
#include "reckon/models/urdf_robot.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;
using models::SensorKind;

std::span<const Choice<SensorKind>> LogKinds() {
  static const std::vector<Choice<SensorKind>> kKinds{
      {SensorKind::kImu, "imu", "gyroscope and accelerometer"},
      {SensorKind::kEncoders, "encoders", "rotary encoders of wheels or joints"},
      {SensorKind::kBodyVelocity, "body_velocity", "a velocity over ground, such as a DVL's"},
      {SensorKind::kDepth, "depth", "a pressure sensor: how deep it lies"},
      {SensorKind::kPose, "pose", "an absolute pose or position from outside"},
      {SensorKind::kContacts, "contacts", "which feet stand"},
      {SensorKind::kTorques, "torques", "of the joints' motors"},
      {SensorKind::kFootForces, "foot_forces", "what presses each foot"}};
  return kKinds;
}

/// A matrix that was rounded when it was written becomes the nearest rotation; nothing for one that
/// is none by more than that.
std::optional<Eigen::Matrix3d> NearestRotation(const std::vector<double>& rows) {
  constexpr double kRounded = 0.02;
  if (rows.size() != 9) return std::nullopt;
  const Eigen::Matrix3d M =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  if (R.determinant() < 0.0 || (R - M).cwiseAbs().maxCoeff() > kRounded) return std::nullopt;
  return R;
}

std::optional<Eigen::Matrix3d> FromQuaternion(const std::array<double, 4>& wxyz) {
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (std::abs(q.norm() - 1.0) > 1e-3) return std::nullopt;
  return q.normalized().toRotationMatrix();
}

class LogRules {
 public:
  LogRules(const LoadedLog& log, Problems& problems) : log_(log), problems_(problems) {}

  void Run() const {
    const LogFile& file = log_.values;
    if (file.sensors.empty()) Complain("/sensors", "expected at least one sensor");
    for (const auto& [name, sensor] : file.sensors) CheckSensor("/sensors/" + name, sensor);
    CheckFile("/truth", file.truth);
    if (file.start && !FromQuaternion(file.start->quaternion_wxyz)) {
      Complain("/start/quaternion_wxyz", "expected a quaternion of length one");
    }
    const std::string& wheels = file.nominal.wheels.encoders;
    if (wheels.empty()) return;
    const auto encoders = file.sensors.find(wheels);
    if (encoders == file.sensors.end() || encoders->second.kind != SensorKind::kEncoders) {
      return Complain("/nominal/wheels/encoders", "expected a sensor of type encoders");
    }
    CheckSide("/left_wheels", file.left_wheels, encoders->second.channels);
    CheckSide("/right_wheels", file.right_wheels, encoders->second.channels);
  }

 private:
  void Complain(std::string path, const std::string& what) const {
    const std::string said = path;
    while (!path.empty() && log_.root.At(path) == nullptr) path.resize(path.rfind('/'));
    const YamlNode* node = path.empty() ? &log_.root : log_.root.At(path);
    problems_.Add(node->at, "'" + said + "': " + what);
  }

  void CheckFile(const std::string& path, const std::string& file) const {
    if (file.empty() || fs::is_regular_file(log_.folder / file)) return;
    Complain(path, "there is no file '" + Shown((log_.folder / file).string()) + "'");
  }

  void CheckSensor(const std::string& path, const LogSensor& sensor) const {
    CheckFile(path + "/file", sensor.file);
    if (!sensor.rotation_matrix.empty() && !NearestRotation(sensor.rotation_matrix)) {
      Complain(path + "/rotation_matrix", "expected the nine numbers of a rotation, row by row");
    }
    if (!FromQuaternion(sensor.quaternion_wxyz)) {
      Complain(path + "/quaternion_wxyz", "expected a quaternion of length one");
    }
    const auto most = static_cast<std::size_t>(models::MostChannels(sensor.kind));
    if (most > 0 && (sensor.channels.empty() || sensor.channels.size() > most)) {
      Complain(path + "/channels", "expected 1 to " + std::to_string(most) + " names");
    }
  }

  void CheckSide(const std::string& path, const std::vector<std::string>& wheels,
                 const std::vector<std::string>& channels) const {
    if (wheels.empty()) Complain(path, "expected at least one channel of the wheels' encoders");
    for (const std::string& wheel : wheels) {
      if (std::find(channels.begin(), channels.end(), wheel) != channels.end()) continue;
      Complain(path, "there is no channel '" + Shown(wheel) + "'" + DidYouMean(wheel, channels));
    }
  }

  const LoadedLog& log_;
  Problems& problems_;
};

std::vector<int> Entries(const std::vector<std::string>& wheels,
                         const std::vector<std::string>& channels) {
  std::vector<int> entries;
  entries.reserve(wheels.size());
  for (const std::string& wheel : wheels) {
    entries.push_back(
        static_cast<int>(std::find(channels.begin(), channels.end(), wheel) - channels.begin()));
  }
  return entries;
}

models::WheelDrive WheelsOf(const LogFile& log) {
  const NominalWheels& nominal = log.nominal.wheels;
  const auto& channels = log.sensors.at(nominal.encoders).channels;
  models::WheelDrive wheels;
  wheels.encoders = nominal.encoders;
  wheels.left = Entries(log.left_wheels, channels);
  wheels.right = Entries(log.right_wheels, channels);
  wheels.rolling_radius_m = nominal.rolling_radius_m;
  wheels.effective_track_m = nominal.effective_track_m;
  wheels.X_BS.p = Eigen::Vector3d(nominal.origin_m[0], nominal.origin_m[1], nominal.origin_m[2]);
  return wheels;
}

models::LegSet LegsOf(const LoadedLog& log) {
  const LogLegs& legs = *log.values.legs;
  const auto encoders = log.values.sensors.find(legs.encoders);
  if (encoders == log.values.sensors.end()) {
    throw std::invalid_argument("the legs' encoders '" + legs.encoders +
                                "' are no sensor of the log");
  }
  const auto robot = models::UrdfRobot::FromFile((log.folder / legs.urdf).string());
  models::LegSet set{legs.encoders, legs.contacts, {}};
  for (const std::string& foot : legs.feet) {
    set.legs.emplace_back(robot, foot, encoders->second.channels);
  }
  return set;
}

}  // namespace

template <class Archive>
void Describe(Archive& a, LogSensor& s) {
  a.Kind("type", s.kind, LogKinds(), "What it sent", Need::kHere);
  a.Field("file", s.file, "A CSV file in the log's folder", {}, Need::kHere);
  a.Field("rate_hz", s.rate_hz, "Nominal samples a second", AboveUpTo(0, 1e5), Need::kHere);
  a.Field("latency_s", s.latency_s, "From validity to arrival, where the file has no arrivals",
          Between(0, 60));
  a.Field("position_m", s.position_m, "Of the sensor's frame in the body", Between(-1e3, 1e3));
  a.Field("quaternion_wxyz", s.quaternion_wxyz, "Takes the sensor's coordinates to the body's",
          Between(-1, 1));
  a.Field("rotation_matrix", s.rotation_matrix, "The same, row by row, instead",
          Between(-1.02, 1.02));
  if (models::MostChannels(s.kind) > 0) {
    a.Field("channels", s.channels, "A name for each entry, as in the file's header");
  }
  if (s.kind == SensorKind::kBodyVelocity) {
    a.Field("noise_m_per_s", s.noise_m_per_s, "Sigma a sample, where the file has no covariance",
            Between(0, 100));
  }
  if (s.kind == SensorKind::kPose) {
    a.Field("noise_position_m", s.noise_position_m, "Sigma a sample, world axes", Between(0, 1e4));
    a.Field("noise_orientation_rad", s.noise_orientation_rad, "Sigma a sample, about world axes",
            Between(0, 3.2));
  }
}

template <class Archive>
void Describe(Archive& a, LogLegs& l) {
  a.Field("urdf", l.urdf, "The robot, in the log's folder", {}, Need::kHere);
  a.Field("encoders", l.encoders, "The sensor whose channels are the joints", {}, Need::kHere);
  a.Field("contacts", l.contacts, "The sensor that says which feet stand", {}, Need::kHere);
  a.Field("feet", l.feet, "Links, in the order of the contact sensor's channels", {}, Need::kHere);
}

template <class Archive>
void Describe(Archive& a, LogStart& s) {
  a.Field("position_m", s.position_m, "Of the body", Between(-1e7, 1e7));
  a.Field("quaternion_wxyz", s.quaternion_wxyz, "Takes the body's coordinates to the world's",
          Between(-1, 1));
  a.Field("velocity_m_s", s.velocity_m_s, "In the world", Between(-1e3, 1e3));
  a.Field("gyro_bias_rad_s", s.gyro_bias_rad_s, "In the body's axes", Between(-10, 10));
  a.Field("accel_bias_m_s2", s.accel_bias_m_s2, "In the body's axes", Between(-100, 100));
}

template <class Archive>
void Describe(Archive& a, LogFile& l) {
  a.Field("schema", l.schema, "Version of this format", Between(1, 1));
  a.Field("description", l.description, "A sentence for people");
  a.Field("gravity_m_s2", l.gravity_m_s2, "Where it was made", AboveUpTo(0, 100));
  a.Map("sensors", l.sensors, LogSensor{}, "The streams, by name");
  a.Field("left_wheels", l.left_wheels, "Channels of the wheels' encoders");
  a.Field("right_wheels", l.right_wheels, "Channels of the wheels' encoders");
  a.Field("nominal", l.nominal, "The robot as estimators know it");
  a.Field("legs", l.legs, "Of a walking robot");
  a.Field("truth", l.truth, "A CSV file with what really happened; empty: unknown");
  a.Field("start", l.start, "Where the robot was when the log began");
}

LoadedLog LoadLog(const fs::path& folder) {
  const fs::path path = folder / "log.yaml";
  if (!fs::is_regular_file(path)) throw LogMissing("there is no log '" + path.string() + "'");
  LoadedLog log;
  log.folder = folder;
  log.root = LoadYamlFile(path);
  Problems problems;
  ReadDocument(log.root, problems, log.values);
  problems.ThrowIfAny();
  LogRules(log, problems).Run();
  problems.ThrowIfAny();
  return log;
}

models::Suite SuiteOf(const LoadedLog& log) {
  models::Suite suite;
  for (const auto& [name, sensor] : log.values.sensors) {
    models::Pose X_BS;
    X_BS.R = sensor.rotation_matrix.empty() ? *FromQuaternion(sensor.quaternion_wxyz)
                                            : *NearestRotation(sensor.rotation_matrix);
    X_BS.p = Eigen::Vector3d(sensor.position_m[0], sensor.position_m[1], sensor.position_m[2]);
    suite.sensors.push_back({name, sensor.kind, X_BS, std::llround(1e9 / sensor.rate_hz)});
  }
  if (!log.values.nominal.wheels.encoders.empty()) suite.wheels = WheelsOf(log.values);
  if (!log.values.legs) return suite;
  try {
    suite.legs = LegsOf(log);
  } catch (const std::invalid_argument& error) {
    Fail(log.root.Find("legs")->at, error.what());
  }
  return suite;
}

namespace {

/// The first type of a simulated sensor that sends `kind`.
sim::SensorType TypeThatSends(SensorKind kind) {
  for (const auto& choice : Choices<sim::SensorType>()) {
    if (sim::KindOf(DefaultErrors(choice.value)) == kind) return choice.value;
  }
  return sim::SensorType::kImu;
}

}  // namespace

std::map<std::string, SensorConfig> SensorsOf(const LogFile& log) {
  std::map<std::string, SensorConfig> sensors;
  for (const auto& [name, sensor] : log.sensors) {
    sensors[name].errors = DefaultErrors(TypeThatSends(sensor.kind));
  }
  return sensors;
}

}  // namespace reckon::harness
