#include "reckon/sim/dvl.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reckon/sim/sample_clock.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void Check(const std::string& name, const DvlConfig& c, const Environment& environment) {
  const std::string who = "sensor '" + name + "'";
  if (environment.surroundings == nullptr) {
    throw std::invalid_argument(who + ": a Doppler log needs a sea around it");
  }
  const std::pair<const char*, double> not_negative[] = {
      {"water_noise_m_per_s", c.water_noise_m_per_s},
      {"offset_m_per_s", c.offset_m_per_s},
      {"scale", c.scale},
      {"altitude_min_m", c.altitude_min_m},
      {"max_speed_m_s", c.max_speed_m_s},
      {"dropout", c.dropout},
      {"assumed_sound_speed_m_s", c.assumed_sound_speed_m_s},
      {"latency_s", c.timing.latency_s}};
  for (const auto& [field, value] : not_negative) RequireNotNegative(name, field, value);
  RequireIn(DvlConfig::kIncidence, c.max_incidence_deg, who, "max_incidence_deg");
  RequireIn(DvlConfig::kMinBeams, c.min_beams, who, "min_beams");
  if (!(c.noise_m_per_s > 0.0)) {  // else the delivered covariance would be zero
    RefuseField(name, "noise_m_per_s", c.noise_m_per_s, "a number above 0");
  }
  if (!(c.timing.rate_hz > 0.0)) {
    RefuseField(name, "rate_hz", c.timing.rate_hz, "a number above 0");
  }
  if (!(c.altitude_max_m > c.altitude_min_m) || !std::isfinite(c.altitude_max_m)) {
    RefuseField(name, "altitude_max_m", c.altitude_max_m, "a number above altitude_min_m");
  }
  double last = 0.0;
  for (const auto& [altitude, rate] : c.rate_by_altitude) {
    if (!(altitude > last && rate > 0.0)) {
      RefuseField(name, "rate_by_altitude", altitude, "rising altitudes and rates above 0");
    }
    last = altitude;
  }
}

}  // namespace

Dvl::Dvl(const std::string& name, models::SensorId id, const models::Pose& X_BS,
         const DvlConfig& config, std::uint64_t seed, const Environment& environment)
    : id_(id),
      X_BS_(X_BS),
      config_(config),
      beams_("sensor '" + name + "'", config.beam_angle_deg, config.azimuths_deg),
      surroundings_(environment.surroundings),
      sound_speed_m_s_(environment.sound_speed_m_s),
      cos_beam_(-beams_.directions().front().z()),
      noise_draws_(seed, name + ".noise"),
      dropout_draws_(seed, name + ".dropout"),
      step_ns_(environment.step_ns) {
  Check(name, config, environment);
  const double assumed = config.assumed_sound_speed_m_s;
  gain_ = (1.0 + config.scale * RandomStream(seed, name + ".scale").Normal(0, 0)) *
          (assumed > 0.0 ? assumed / sound_speed_m_s_ : 1.0);
  const RandomStream offset_draws(seed, name + ".offset");
  for (std::uint32_t i = 0; i < beams_.directions().size(); ++i) {
    offset_m_s_[i] = config.offset_m_per_s * offset_draws.Normal(i, 0);
  }
  next_ping_ns_ = PeriodNs();
}

/// A whole number of physics steps. Without the ground, that of the greatest altitude.
models::TimeNs Dvl::PeriodNs() const {
  double rate_hz = config_.timing.rate_hz;
  for (const auto& [altitude, rate] : config_.rate_by_altitude) {
    rate_hz = std::min(config_.timing.rate_hz, rate);
    if (altitude_m_ <= altitude) break;
  }
  return std::max<models::TimeNs>(1, std::llround(1.0 / (rate_hz * models::Seconds(step_ns_)))) *
         step_ns_;
}

Vector3d Dvl::VelocityIn(const MotionWindow& motion) const {
  const Vector3d water = over_ground_ ? Vector3d::Zero() : motion.water_velocity_m_s;
  return (motion.X_WB.R * X_BS_.R).transpose() * (motion.Velocity(X_BS_.p) - water);
}

void Dvl::CastBeams(const MotionWindow& motion) {
  const models::Pose X_WS = motion.X_WB * X_BS_;
  const double least_cos = std::cos(config_.max_incidence_deg * std::numbers::pi / 180.0);
  for (std::uint32_t i = 0; i < beams_.directions().size(); ++i) {
    const auto hit = surroundings_->Cast(X_WS.p, X_WS.R * beams_.directions()[i]);
    Echo& echo = echoes_[i];
    echo = {};
    if (!hit || dropout_draws_.Uniform(i, pings_) < config_.dropout) continue;
    const double altitude = hit->range_m * cos_beam_;
    if (altitude < config_.altitude_min_m || altitude > config_.altitude_max_m) continue;
    if (hit->cos_incidence < least_cos) continue;
    echo.answers = true;
    echo.range_m = hit->range_m;
  }
}

/// All beams are answered by the water under the log.
void Dvl::AskTheWater() {
  over_ground_ = false;
  for (std::size_t i = 0; i < beams_.directions().size(); ++i) {
    echoes_[i] = {};
    echoes_[i].answers = true;
    echoes_[i].range_m = config_.water_layer_m / cos_beam_;
  }
}

/// How many beams answer; and how far away what they meet is on the mean.
int Dvl::CountEchoes() {
  int answers = 0;
  double sum = 0.0;
  for (const Echo& echo : echoes_) {
    answers += echo.answers ? 1 : 0;
    sum += echo.range_m;
  }
  mean_range_m_ = answers > 0 ? sum / answers : 0.0;
  return answers;
}

void Dvl::Ping(const MotionWindow& motion) {
  over_ground_ = true;
  CastBeams(motion);
  if (VelocityIn(motion).norm() > config_.max_speed_m_s) echoes_ = {};
  bool locked = CountEchoes() >= config_.min_beams;
  altitude_m_ = locked ? mean_range_m_ * cos_beam_ : config_.altitude_max_m;
  if (!locked && config_.water_track) {
    AskTheWater();
    locked = CountEchoes() >= config_.min_beams;
  }
  ping_s_ = models::Seconds(motion.t_ns);
  // Without lock it listens as long as the farthest echo could take.
  double farthest = locked ? 0.0 : config_.altitude_max_m / cos_beam_;
  for (Echo& echo : echoes_) {
    echo.t_s = ping_s_ + 2.0 * echo.range_m / sound_speed_m_s_;
    farthest = std::max(farthest, echo.range_m);
  }
  end_s_ = ping_s_ + 2.0 * farthest / sound_speed_m_s_;
  sent_m_s_ = last_m_s_ = VelocityIn(motion);
  next_ping_ns_ = motion.t_ns + PeriodNs();
  listening_ = true;
}

void Dvl::Listen(const MotionWindow& motion) {
  const double t_s = models::Seconds(motion.t_ns), step_s = models::Seconds(step_ns_);
  const Vector3d now = VelocityIn(motion);
  const double sigma = Sigma();
  for (std::uint32_t i = 0; i < beams_.directions().size(); ++i) {
    Echo& echo = echoes_[i];
    if (!echo.answers || echo.along_m_s || echo.t_s > t_s) continue;
    const Vector3d back = now + (t_s - echo.t_s) / step_s * (last_m_s_ - now);
    const double noise = sigma > 0.0 ? sigma * noise_draws_.Normal(i, pings_) : 0.0;
    echo.along_m_s =
        0.5 * gain_ * beams_.directions()[i].dot(sent_m_s_ + back) + offset_m_s_[i] + noise;
  }
  last_m_s_ = now;
}

models::BodyVelocitySample Dvl::Solution() const {
  std::array<std::optional<double>, DvlBeams::kMost> along;
  models::BodyVelocitySample sample;
  sample.over_ground = over_ground_;
  const std::size_t count = beams_.directions().size();
  for (std::size_t i = 0; i < count; ++i) {
    along[i] = echoes_[i].along_m_s;
    if (along[i]) sample.beams = static_cast<std::uint8_t>(sample.beams | (1U << i));
  }
  const auto solution = beams_.Solve({along.data(), count}, Sigma());
  sample.valid = solution && solution->beams >= config_.min_beams;
  sample.v_WS_S = sample.valid ? solution->velocity_m_s : Vector3d::Constant(kNan);
  sample.covariance = sample.valid ? solution->covariance_m2_s2 : Eigen::Matrix3d::Constant(kNan);
  sample.figure_of_merit_m_s = sample.valid ? solution->disagreement_m_s : kNan;
  return sample;
}

models::Measurement Dvl::Speak() const {
  models::Measurement message{id_, 0, 0, Solution()};
  const double valid_s = ping_s_ + mean_range_m_ / sound_speed_m_s_ + config_.timing.stamp_error_s;
  message.valid_ns = std::llround(1e9 * valid_s);
  const auto spoken_ns = std::llround(1e9 * (end_s_ + config_.timing.latency_s));
  message.arrival_ns = std::max<models::TimeNs>(spoken_ns, message.valid_ns);
  return message;
}

void Dvl::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == step_ns_);
  if (listening_) Listen(motion);
  if (listening_ && end_s_ <= models::Seconds(motion.t_ns)) {
    out.push_back(Speak());
    listening_ = false;
    ++pings_;
  }
  if (!listening_ && motion.t_ns >= next_ping_ns_) Ping(motion);
}

}  // namespace reckon::sim
