#include "reckon/harness/scenario_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/drive_rules.h"
#include "reckon/harness/rule_book.h"
#include "reckon/harness/scenario_metrics.h"
#include "reckon/harness/yaml_values.h"
#include "reckon/sim/dvl_beams.h"
#include "reckon/sim/imu.h"

namespace reckon::harness {
namespace {

template <class T>
Names KeysOf(const std::map<std::string, T>& map) {
  Names names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

/// The rules, with what all of them need.
class Rules : private RuleBook {
 public:
  Rules(const Scenario& scenario, const YamlNode& root, Problems& problems)
      : RuleBook(root, problems), s_(scenario), sensors_(KeysOf(scenario.sensors)) {}

  void Run(const models::UrdfRobot& urdf, const std::string& base_link) const {
    // Nothing divides a step that stamps can't hold.
    const bool step_is_good = IsWhole(s_.world.physics_step_s * 1e9);
    Require(step_is_good, "/world/physics_step_s", "a whole number of nanoseconds");
    if (!step_is_good) return;
    CheckDriven(s_, urdf, base_link, *this);
    CheckSensors(urdf);
    CheckFaults();
    for (const auto& [name, estimator] : s_.estimators) CheckEstimator(name, estimator);
    CheckRate("/record/truth_rate_hz", s_.record.truth_rate_hz);
    Require(s_.score.start_s < s_.duration_s, "/score/start_s", "a time before the run's end");
    CheckExpectations();
  }

  void RunLog() const {
    for (const auto& [name, estimator] : s_.estimators) {
      CheckEstimator(name, estimator);
      Require(estimator.noise_source != NoiseSource::kMatched, "/estimators/" + name + "/noise",
              "nominal or numbers: the true noise of a log is not known");
    }
    CheckExpectations();
  }

 private:
  static bool IsWhole(double number) {
    constexpr double kRoundOff = 1e-9;
    return std::abs(number - std::round(number)) <= kRoundOff * std::abs(number);
  }

  models::TimeNs StepNs() const { return std::llround(s_.world.physics_step_s * 1e9); }

  /// A rate must be an integer fraction of the physics rate. Whether it is.
  bool CheckRate(const std::string& path, double rate_hz) const {
    const double steps = 1.0 / (rate_hz * s_.world.physics_step_s);
    const double whole = std::max(1.0, std::round(steps));
    if (steps > 0.5 && IsWhole(steps)) return true;
    const double nearest = 1.0 / (whole * s_.world.physics_step_s);
    Complain(path, "expected an integer fraction of the physics rate of " +
                       NumberText(1.0 / s_.world.physics_step_s) + " Hz, found " +
                       NumberText(rate_hz) + "; the nearest is " + NumberText(nearest));
    return false;
  }

  void CheckSensors(const models::UrdfRobot& urdf) const {
    Names links;
    for (const auto& link : urdf.links()) links.push_back(link.name);
    for (const auto& [name, sensor] : s_.sensors) {
      const std::string path = "/sensors/" + name;
      RequireOneOf(sensor.frame, links, path + "/frame", "link in the URDF called");
      const auto rate = [](const auto& errors) { return errors.timing.rate_hz; };
      const double rate_hz = std::visit(rate, sensor.errors);
      if (const auto* dvl = std::get_if<sim::DvlConfig>(&sensor.errors)) {
        CheckDvl(path, *dvl);
        continue;  // it pings when it can
      }
      const bool divides = CheckRate(path + "/rate_hz", rate_hz);
      if (const auto* imu = std::get_if<sim::ImuConfig>(&sensor.errors)) {
        const double most = sim::LargestBandwidthHz(StepNs());
        Require(imu->bandwidth_hz <= most, path + "/bandwidth_hz",
                "at most half the physics rate, " + NumberText(most) + " Hz");
      }
      const auto* encoders = std::get_if<sim::EncoderConfig>(&sensor.errors);
      if (encoders != nullptr && divides) {
        CheckWindow(path + "/rate_window_s", encoders->rate_window_s, 1.0 / rate_hz);
      }
    }
    CheckWheels();
  }

  void CheckDvl(const std::string& path, const sim::DvlConfig& dvl) const {
    if (!s_.world.water) Complain(path + "/type", "a Doppler log needs a sea around it");
    Require(dvl.altitude_min_m < dvl.altitude_max_m, path + "/altitude_max_m",
            "more than altitude_min_m");
    double last = 0.0;
    for (const auto& [altitude, rate] : dvl.rate_by_altitude) {
      Require(altitude > last, path + "/rate_by_altitude", "altitudes that rise");
      last = altitude;
    }
    try {
      const sim::DvlBeams check("beams", dvl.beam_angle_deg, dvl.azimuths_deg);
    } catch (const std::invalid_argument& error) {
      Complain(path + "/azimuths_deg", error.what());
    }
  }

  void CheckWindow(const std::string& path, double window_s, double period_s) const {
    const double step_s = s_.world.physics_step_s, steps = window_s / step_s;
    Require(steps > 0.5 && IsWhole(steps), path, "a whole number of physics steps");
    Require(std::round(steps) <= std::round(period_s / step_s), path,
            "at most the sample period of " + NumberText(period_s) + " s");
  }

  void CheckWheels() const {
    const std::string& wheels = s_.nominal.wheels.encoders;
    const auto it = s_.sensors.find(wheels);
    if (it == s_.sensors.end()) return;  // removed: then there are no wheels to believe in
    Require(std::holds_alternative<sim::EncoderConfig>(it->second.errors),
            "/nominal/wheels/encoders", "a sensor of type encoders");
    Require(s_.nominal.wheels.rolling_radius_m > 0, "/nominal/wheels/rolling_radius_m",
            "a number above 0");
    Require(s_.nominal.wheels.effective_track_m > 0, "/nominal/wheels/effective_track_m",
            "a number above 0");
  }

  void CheckFaults() const {
    for (std::size_t i = 0; i < s_.faults.size(); ++i) {
      const std::string path = "/faults/" + std::to_string(i);
      RequireOneOf(s_.faults[i].sensor, sensors_, path + "/sensor", "sensor");
      Require(s_.faults[i].at_s < s_.duration_s, path + "/at_s", "a time before the run's end");
      CheckChannels(path + "/channels", s_.faults[i]);
    }
  }

  void CheckChannels(const std::string& path, const sim::FaultConfig& fault) const {
    const auto sensor = s_.sensors.find(fault.sensor);
    if (sensor == s_.sensors.end() || sim::HasChannels(sensor->second.errors, fault.channels)) {
      return;
    }
    Names names;
    for (const auto& choice : Choices<sim::FaultChannels>()) {
      if (sim::HasChannels(sensor->second.errors, choice.value)) names.push_back(choice.name);
    }
    Require(false, path,
            fmt::format("channels of the sensor '{}' ({})", fault.sensor, fmt::join(names, ", ")));
  }

  void CheckEstimator(const std::string& name, const EstimatorConfig& estimator) const {
    const std::string path = "/estimators/" + name;
    if (name == "truth" || name == "compare" || name == "exit_code") {
      Complain(path, "this name is taken; choose another for the estimator");
    }
    std::set<std::string> seen;
    for (std::size_t i = 0; i < estimator.sensors.size(); ++i) {
      const std::string place = path + "/sensors/" + std::to_string(i);
      RequireOneOf(estimator.sensors[i], sensors_, place, "sensor");
      Require(seen.insert(estimator.sensors[i]).second, place, "each sensor once");
    }
    for (const auto& [sensor, error] : estimator.mounting_error) {
      RequireOneOf(sensor, sensors_, path + "/mounting_error/" + sensor, "sensor");
    }
    if (estimator.type == "process") {
      Require(!estimator.command.empty() && !estimator.command.front().empty(), path + "/command",
              "a program and its arguments");
      return;
    }
    const std::string& wheels = s_.nominal.wheels.encoders;
    if (estimator.type != "odometry") {
      if (!Sees<sim::ImuConfig>(estimator)) {
        Complain(path, "type '" + estimator.type + "' needs an IMU, and is given none");
      }
      CheckInitialisation(path, estimator);
      CheckGyroFilter(path + "/gyro_filter/source", estimator);
      CheckContacts(path + "/contacts", estimator);
      CheckBelievedNoise(path, estimator);
    } else if (!s_.sensors.contains(wheels)) {
      Complain(path, "type 'odometry' needs wheel encoders, and this robot has none");
    } else if (!IsGiven(estimator, wheels)) {
      Complain(path, "type 'odometry' needs wheel encoders, and is given none");
    }
  }

  void CheckInitialisation(const std::string& path, const EstimatorConfig& estimator) const {
    if (estimator.initialisation.kind != estimator::InitialisationKind::kPose) return;
    const auto knows_orientation = [](const sim::PoseConfig& pose) { return pose.orientation; };
    if (Sees<sim::PoseConfig>(estimator, knows_orientation)) return;
    Complain(path + "/initialisation/kind",
             "'pose' needs a pose sensor that knows its orientation, and is given none");
  }

  /// The IMU that moves a filter: the robot's first, by name; empty if there is none.
  std::string FirstImu() const {
    for (const auto& [name, sensor] : s_.sensors) {
      if (std::holds_alternative<sim::ImuConfig>(sensor.errors)) return name;
    }
    return "";
  }

  void CheckGyroFilter(const std::string& path, const EstimatorConfig& estimator) const {
    const std::string& source = estimator.gyro_filter.source;
    if (source.empty()) return;
    RequireOneOf(source, sensors_, path, "sensor");
    const auto sensor = s_.sensors.find(source);
    if (sensor == s_.sensors.end()) return;
    const bool wheels = source == s_.nominal.wheels.encoders;
    Require(wheels || std::holds_alternative<sim::ImuConfig>(sensor->second.errors), path,
            "an IMU or the wheels' encoders");
    Require(source != FirstImu(), path, "another IMU than the one that it refines");
    Require(IsGiven(estimator, source), path, "a sensor that the estimator is given");
    Require(!wheels || estimator.noise.wheel_yaw_rate_rad_per_s > 0.0, path,
            "a positive noise wheel_yaw_rate_rad_per_s beside wheels");
  }

  void CheckContacts(const std::string& path, const EstimatorConfig& estimator) const {
    const std::string& source = estimator.contacts.sensor;
    if (source.empty()) return;
    RequireOneOf(source, sensors_, path + "/sensor", "sensor");
    const auto sensor = s_.sensors.find(source);
    if (sensor == s_.sensors.end()) return;
    using Kind = models::SensorKind;
    const Kind kind = sim::KindOf(sensor->second.errors);
    Require(kind == Kind::kContacts || kind == Kind::kTorques || kind == Kind::kFootForces,
            path + "/sensor", "a sensor of contacts, torques or foot forces");
    Require(IsGiven(estimator, source), path + "/sensor", "a sensor that the estimator is given");
  }

  /// What is used must be weighed: no sigma of it can be zero.
  void CheckBelievedNoise(const std::string& path, const EstimatorConfig& estimator) const {
    Require(!estimator.standstill.use || estimator.noise.standstill_m_per_s > 0.0,
            path + "/standstill/use", "a positive noise standstill_m_per_s beside it");
    Require(estimator.noise.depth_m > 0.0 || !Sees<sim::DepthConfig>(estimator), path + "/noise",
            "a positive depth_m: the estimator is given a depth sensor");
    Require(!estimator.floor.use || estimator.noise.floor_height_m > 0.0, path + "/floor/use",
            "a positive noise floor_height_m beside it");
    const bool velocity = estimator.leg_correction == estimator::LegCorrection::kVelocity;
    const bool weighed = estimator.noise.leg_velocity_m_per_s > 0.0;
    Require(!velocity || weighed, path + "/leg_correction",
            "a positive noise leg_velocity_m_per_s beside velocity");
    Require(estimator.slip.rule != estimator::SlipRule::kNis || weighed, path + "/slip/rule",
            "a positive noise leg_velocity_m_per_s beside nis");
    Require(!velocity || estimator.slip.rule == estimator::SlipRule::kOff, path + "/slip/rule",
            "off: legs used as a velocity have no feet in the state");
  }

  static bool IsGiven(const EstimatorConfig& estimator, const std::string& sensor) {
    const auto& given = estimator.sensors;
    return given.empty() || std::find(given.begin(), given.end(), sensor) != given.end();
  }

  /// Whether the estimator is given a sensor of this type, of those that are `fit`.
  template <class Config, class Fit>
  bool Sees(const EstimatorConfig& estimator, const Fit& fit) const {
    return std::any_of(s_.sensors.begin(), s_.sensors.end(), [&](const auto& entry) {
      const auto* config = std::get_if<Config>(&entry.second.errors);
      return config != nullptr && fit(*config) && IsGiven(estimator, entry.first);
    });
  }
  template <class Config>
  bool Sees(const EstimatorConfig& estimator) const {
    return Sees<Config>(estimator, [](const Config&) { return true; });
  }

  void CheckExpectations() const {
    Require(s_.expect.exit_code != 2, "/expect/exit_code",
            "0, 1 or 3: a run that starts can't end with 2");
    const Names metrics = MetricNames(sensors_, s_.score, FeetOf(s_));
    const Names estimators = KeysOf(s_.estimators);
    for (const auto& [name, expectation] : s_.expect.estimators) {
      const std::string path = "/expect/" + name;
      RequireOneOf(name, estimators, path, "estimator");
      for (const Bound& bound : expectation.bounds) {
        const std::string place = path + "/" + bound.metric;
        RequireOneOf(bound.metric, metrics, place, "metric");
        Require(bound.min || bound.max, place, "a bound `min` or `max`");
        Require(!bound.min || !bound.max || *bound.min <= *bound.max, place, "min of at most max");
      }
    }
    for (std::size_t i = 0; i < s_.expect.compare.size(); ++i) {
      const Comparison& c = s_.expect.compare[i];
      const std::string path = "/expect/compare/" + std::to_string(i);
      RequireOneOf(c.left_estimator, estimators, path, "estimator");
      RequireOneOf(c.right_estimator, estimators, path, "estimator");
      RequireOneOf(c.left_metric, metrics, path, "metric");
      RequireOneOf(c.right_metric, metrics, path, "metric");
    }
  }

  const Scenario& s_;
  Names sensors_;
};

}  // namespace

void CheckScenario(const Scenario& scenario, const models::UrdfRobot& urdf,
                   const std::string& base_link, const YamlNode& root, Problems& problems) {
  Rules(scenario, root, problems).Run(urdf, base_link);
}

void CheckLogScenario(const Scenario& scenario, const YamlNode& root, Problems& problems) {
  Rules(scenario, root, problems).RunLog();
}

}  // namespace reckon::harness
