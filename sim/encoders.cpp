#include "reckon/sim/encoders.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <sstream>

namespace reckon::sim {
namespace {

models::TimeNs WindowNs(const std::string& sensor, double window_s, const SampleClock& clock) {
  const double steps = window_s * 1e9 / static_cast<double>(clock.step_ns());
  const models::TimeNs most = clock.period_ns() / clock.step_ns();
  const bool whole = steps < 1e9 && std::abs(steps - std::round(steps)) <= 1e-6 * steps;
  if (!whole || std::round(steps) < 1.0 || std::llround(steps) > most) {
    std::ostringstream allowed;
    allowed << "a whole number of physics steps of " << models::Seconds(clock.step_ns())
            << " s and at most the sample period of " << models::Seconds(clock.period_ns()) << " s";
    RefuseField(sensor, "rate_window_s", window_s, allowed.str());
  }
  return std::llround(steps) * clock.step_ns();
}

}  // namespace

Encoders::Encoders(const std::string& name, models::SensorId id, const EncoderConfig& config,
                   std::uint64_t seed, models::TimeNs physics_step_ns)
    : id_(id),
      clock_(name, config.timing, physics_step_ns),
      window_ns_(WindowNs(name, config.rate_window_s, clock_)),
      counts_per_rad_(config.counts_per_rad),
      noise_(config.noise_rad),
      eccentricity_(config.eccentricity_rad),
      noise_draws_(seed, name + ".noise") {
  RequireNotNegative(name, "rate_filter_hz", config.rate_filter_hz);
  if (config.rate_filter_hz > 0.0) {
    const double period_s = models::Seconds(clock_.period_ns());
    rate_decay_ = std::exp(-2.0 * std::numbers::pi * config.rate_filter_hz * period_s);
  }
  RequireNotNegative(name, "counts_per_rad", config.counts_per_rad);
  RequireNotNegative(name, "noise_rad", config.noise_rad);
  RequireNotNegative(name, "eccentricity_rad", config.eccentricity_rad);
  RequireNotNegative(name, "offset_rad", config.offset_rad);
  RequireNotNegative(name, "scale", config.scale);
  const RandomStream scale(seed, name + ".scale"), phase(seed, name + ".phase"),
      offset(seed, name + ".offset");
  for (std::uint32_t i = 0; i < models::kMaxEncoders; ++i) {
    gain_[i] = 1.0 + config.scale * scale.Normal(i, 0);
    phase_[i] = 2.0 * std::numbers::pi * phase.Uniform(i, 0);
    offset_[i] = config.offset_rad * offset.Normal(i, 0);
    if (i < config.actual_offset_rad.size()) offset_[i] += config.actual_offset_rad[i];
  }
}

void Encoders::Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) {
  assert(motion.step_ns == clock_.step_ns());
  const models::TimeNs end_ns = clock_.next_ns();
  if (clock_.IsSample(motion.t_ns)) {
    models::EncoderSample sample;
    sample.angle_rad = Read(motion);
    if (rate_.size() == 0) rate_ = models::EncoderVector::Zero(sample.angle_rad.size());
    const models::EncoderVector mean = (sample.angle_rad - begin_) / models::Seconds(window_ns_);
    rate_ = mean + rate_decay_ * (rate_ - mean);
    sample.rate_rad_s = rate_;
    sample.interval_ns = window_ns_;
    if (window_ns_ == clock_.period_ns()) begin_ = sample.angle_rad;
    out.push_back({id_, clock_.Valid(end_ns), clock_.Arrival(end_ns), sample});
    clock_.Advance();
  } else if (motion.t_ns == end_ns - window_ns_) {
    begin_ = Read(motion);
  }
}

models::EncoderVector Encoders::Read(const MotionWindow& motion) const {
  models::EncoderVector reading = motion.joint_angle_rad;
  const auto step = static_cast<std::uint64_t>(motion.t_ns / motion.step_ns);
  for (int i = 0; i < reading.size(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const double q = reading[i];
    double q_m = q * gain_[n] + offset_[n];
    if (eccentricity_ > 0.0) q_m += eccentricity_ * std::sin(q + phase_[n]);
    if (noise_ > 0.0) q_m += noise_ * noise_draws_.Normal(static_cast<std::uint32_t>(i), step);
    if (counts_per_rad_ > 0.0) q_m = std::floor(q_m * counts_per_rad_) / counts_per_rad_;
    reading[i] = q_m;
  }
  return reading;
}

}  // namespace reckon::sim
