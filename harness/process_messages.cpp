#include "reckon/harness/process_messages.h"

#include <array>
#include <string>
#include <variant>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "reckon/ground_truth/recording_columns.h"
#include "reckon/harness/process_answer.h"

namespace reckon::harness {
namespace {

using Json = nlohmann::ordered_json;

template <typename Derived>
Json Numbers(const Eigen::DenseBase<Derived>& values) {
  Json out = Json::array();
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      out.push_back(values.derived()(row, column));
    }
  }
  return out;
}

Json Quaternion(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {q.w(), q.x(), q.y(), q.z()};
}

Json Frame(const models::Pose& X_BS) {
  return {{"q_BS", Quaternion(X_BS.R)}, {"p_BS_m", Numbers(X_BS.p)}};
}

Json Sensors(const models::Suite& suite) {
  const auto kinds = ground_truth::SensorKindNames();
  Json out = Json::array();
  for (std::size_t id = 0; id < suite.sensors.size(); ++id) {
    const models::MountedSensor& sensor = suite.sensors[id];
    Json entry{{"id", id},
               {"name", sensor.name},
               {"kind", kinds[static_cast<std::size_t>(sensor.kind)]},
               {"period_ns", sensor.period_ns}};
    entry.update(Frame(sensor.X_BS));
    out.push_back(std::move(entry));
  }
  return out;
}

Json Wheels(const models::Suite& suite) {
  if (!suite.wheels) return nullptr;
  const models::WheelDrive& wheels = *suite.wheels;
  Json out{{"encoders", wheels.encoders},
           {"left", wheels.left},
           {"right", wheels.right},
           {"rolling_radius_m", wheels.rolling_radius_m},
           {"effective_track_m", wheels.effective_track_m}};
  out.update(Frame(wheels.X_BS));
  return out;
}

Json Beliefs(const estimator::Setup& setup) {
  constexpr std::array kActions{"off", "warn", "reject", "inflate"};
  constexpr std::array kKinds{"prior", "static", "pose"};
  Json noise = Json::object();
  for (const auto& field : estimator::NoiseFields()) {
    noise[std::string(field.name)] = setup.noise.*field.member;
  }
  const estimator::PriorSigma& sigma = setup.prior_sigma;
  return {{"noise", std::move(noise)},
          {"gate",
           {{"action", kActions.at(static_cast<std::size_t>(setup.gate.action))},
            {"probability", setup.gate.probability}}},
          {"initialisation",
           {{"kind", kKinds.at(static_cast<std::size_t>(setup.initialisation.kind))},
            {"static_duration_s", setup.initialisation.static_duration_s}}},
          {"prior_sigma",
           {{"roll_pitch_rad", sigma.roll_pitch_rad},
            {"yaw_rad", sigma.yaw_rad},
            {"velocity_m_s", sigma.velocity_m_s},
            {"position_m", sigma.position_m},
            {"gyro_bias_rad_s", sigma.gyro_bias_rad_s},
            {"accel_bias_m_s2", sigma.accel_bias_m_s2}}},
          {"iterations", setup.iterations},
          {"history_s", setup.history_s},
          {"standstill", {{"use", setup.standstill.use}, {"window_s", setup.standstill.window_s}}},
          {"floor", {{"use", setup.floor.use}, {"height_m", setup.floor.height_m}}},
          {"gyro_filter",
           {{"source", setup.gyro_filter.source},
            {"bias_sigma_rad_s", setup.gyro_filter.bias_sigma_rad_s}}},
          {"estimate_gyro_bias", setup.estimate_gyro_bias},
          {"estimate_accel_bias", setup.estimate_accel_bias},
          {"gravity_m_s2", setup.gravity_m_s2}};
}

void AddSample(Json& message, const models::ImuSample& imu) {
  message["message"] = "imu";
  message["interval_ns"] = imu.interval_ns;
  message["gyro_rad_s"] = Numbers(imu.gyro_rad_s);
  message["accel_m_s2"] = Numbers(imu.accel_m_s2);
  message["gyro_saturated"] = imu.gyro_saturated;
  message["accel_saturated"] = imu.accel_saturated;
}

void AddSample(Json& message, const models::EncoderSample& encoders) {
  message["message"] = "encoders";
  message["interval_ns"] = encoders.interval_ns;
  message["angle_rad"] = Numbers(encoders.angle_rad);
  message["rate_rad_s"] = Numbers(encoders.rate_rad_s);
}

void AddSample(Json& message, const models::BodyVelocitySample& velocity) {
  message["message"] = "body_velocity";
  message["v_WS_S_m_s"] = Numbers(velocity.v_WS_S);
  message["covariance_m2_s2"] = Numbers(velocity.covariance);
  message["valid"] = velocity.valid;
  message["over_ground"] = velocity.over_ground;
  message["figure_of_merit_m_s"] = velocity.figure_of_merit_m_s;
}

void AddSample(Json& message, const models::DepthSample& depth) {
  message["message"] = "depth";
  message["depth_m"] = depth.depth_m;
}

void AddSample(Json& message, const models::PoseSample& pose) {
  message["message"] = "pose";
  message["p_WS_m"] = Numbers(pose.X_WS.p);
  message["position_sigma_m"] = Numbers(pose.position_sigma_m);
  message["q_WS"] = pose.has_orientation ? Quaternion(pose.X_WS.R) : Json();
  message["orientation_sigma_rad"] =
      pose.has_orientation ? Numbers(pose.orientation_sigma_rad) : Json();
}

void AddSample(Json& message, const models::ContactSample& contacts) {
  message["message"] = "contacts";
  message["probability"] = Numbers(contacts.probability);
}

void AddSample(Json& message, const models::TorqueSample& torques) {
  message["message"] = "torques";
  message["torque_n_m"] = Numbers(torques.torque_n_m);
}

void AddSample(Json& message, const models::FootForceSample& forces) {
  message["message"] = "foot_forces";
  message["force_n"] = Numbers(forces.force_n);
}

std::string Line(const Json& message) { return message.dump() + '\n'; }

}  // namespace

std::string HelloMessage(std::string_view robot, const estimator::Setup& setup) {
  Json message{{"message", "hello"},
               {"schema", kProcessSchema},
               {"robot", robot},
               {"sensors", Sensors(setup.suite)},
               {"wheels", Wheels(setup.suite)}};
  message.update(Beliefs(setup));
  message["covariance_order"] = {"theta", "v", "p", "gyro_bias", "accel_bias"};
  for (const ErrorFormName& form : ErrorFormNames()) {
    message["error_forms"][std::string(form.name)] = form.meaning;
  }
  return Line(message);
}

std::string StartMessage(const estimator::Prior& prior) {
  return Line({{"message", "start"},
               {"t_ns", prior.t_ns},
               {"q_WB", Quaternion(prior.X_WB.R)},
               {"p_WB", Numbers(prior.X_WB.p)},
               {"v_WB", Numbers(prior.v_WB)},
               {"w_WB_B", Numbers(prior.w_WB_B)},
               {"gyro_bias_rad_s", Numbers(prior.gyro_bias_rad_s)},
               {"accel_bias_m_s2", Numbers(prior.accel_bias_m_s2)},
               {"covariance", Numbers(prior.covariance)}});
}

std::string MeasurementMessage(const models::Measurement& measurement) {
  Json message{{"message", ""},
               {"sensor", measurement.sensor},
               {"valid_ns", measurement.valid_ns},
               {"arrival_ns", measurement.arrival_ns}};
  std::visit([&message](const auto& sample) { AddSample(message, sample); }, measurement.sample);
  return Line(message);
}

}  // namespace reckon::harness
