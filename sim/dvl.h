#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/models/pose.h"
#include "reckon/sim/dvl_beams.h"
#include "reckon/sim/environment.h"
#include "reckon/sim/random_stream.h"
#include "reckon/sim/sensor.h"
#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// A Doppler velocity log. It pings at t_tx; a ray along each beam u_i finds the range r_i of what
/// the beam meets, and its echo comes back at t_i = t_tx + 2 r_i/c. A beam says
///     y_i = ½ u_i·(v_S(t_tx) + v_S(t_i)) (1 + s) c_assumed/c + b_i + σ n
/// of the velocity of its origin in its axes (s, b_i drawn once a run), unless the ground is too
/// near, too far or too oblique, the log too fast, or the echo lost by chance. `DvlBeams` makes the
/// velocity and its covariance of what the beams say, valid at the mean echo's reflection,
/// t_tx + r̄/c. The message is sent after the last echo; without enough beams, after the time of the
/// longest one, as invalid. The time to the next ping follows from the altitude that was seen last.
///
/// Over water (`water_track`) the velocity is that relative to the water, if too few beams see the
/// ground: all beams answer from `water_layer_m` under it.
///
/// Draws come from "<name>.noise" (channel = beam, index = ping), "<name>.dropout" (likewise),
/// "<name>.offset" (channel = beam) and "<name>.scale".
class Dvl : public Sensor {
 public:
  /// Throws std::invalid_argument for what DvlBeams refuses, numbers out of range, and an
  /// environment without surroundings.
  Dvl(const std::string& name, models::SensorId id, const models::Pose& X_BS,
      const DvlConfig& config, std::uint64_t seed, const Environment& environment);

  void Observe(const MotionWindow& motion, std::vector<models::Measurement>& out) override;

 private:
  /// What one beam has to say of the ping that is on its way.
  struct Echo {
    bool answers = false;
    double range_m = 0.0, t_s = 0.0;
    std::optional<double> along_m_s;
  };
  using Echoes = std::array<Echo, DvlBeams::kMost>;

  void Ping(const MotionWindow& motion);
  void CastBeams(const MotionWindow& motion);
  void AskTheWater();
  int CountEchoes();
  void Listen(const MotionWindow& motion);
  models::Measurement Speak() const;
  models::BodyVelocitySample Solution() const;
  Eigen::Vector3d VelocityIn(const MotionWindow& motion) const;
  double Sigma() const {
    return over_ground_ ? config_.noise_m_per_s : config_.water_noise_m_per_s;
  }
  models::TimeNs PeriodNs() const;

  models::SensorId id_;
  models::Pose X_BS_;
  DvlConfig config_;
  DvlBeams beams_;
  const Surroundings* surroundings_;
  double sound_speed_m_s_, cos_beam_, gain_;
  std::array<double, DvlBeams::kMost> offset_m_s_{};
  RandomStream noise_draws_, dropout_draws_;
  models::TimeNs step_ns_, next_ping_ns_;

  std::uint64_t pings_ = 0;
  bool listening_ = false, over_ground_ = true;
  double altitude_m_ = 0.0;    ///< as seen last; 0: not yet
  double mean_range_m_ = 0.0;  ///< of the echoes of this ping; 0: none
  double ping_s_ = 0.0, end_s_ = 0.0;
  Eigen::Vector3d sent_m_s_, last_m_s_;  ///< v_S at the ping, and at the step before this
  Echoes echoes_;
};

}  // namespace reckon::sim
