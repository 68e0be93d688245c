#include "reckon/sim/dvl.h"

#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "reckon/sim/dvl_grades.h"
#include "sim/analytic_motion.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using models::BodyVelocitySample;
using models::Measurement;
using testing_sim::Watch;

constexpr models::TimeNs kMs = 1'000'000;
constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kSoundSpeed = 1500.0;

/// A horizontal bottom at z = −depth, which `hides` some rays.
struct Bottom : Surroundings {
  double depth = 10.0;
  std::function<bool(const Vector3d& direction)> hides = [](const Vector3d&) { return false; };

  std::optional<RayHit> Cast(const Vector3d& from, const Vector3d& direction) const override {
    if (direction.z() >= 0.0 || hides(direction)) return std::nullopt;
    return RayHit{(from.z() + depth) / -direction.z(), -direction.z()};
  }
};

/// A body that moves with a constant velocity and stays level.
struct Steady {
  Vector3d v = {0.7, -0.4, 0.2};
  Vector3d p = Vector3d::Zero();
  models::Pose At(double t) const { return {Eigen::Matrix3d::Identity(), p + t * v}; }
};

BodyVelocitySample SampleOf(const Measurement& m) { return std::get<BodyVelocitySample>(m.sample); }

DvlConfig Quiet() {
  DvlConfig config;
  config.timing = {.rate_hz = 10.0, .latency_s = 0.02};
  config.noise_m_per_s = 1e-12;  // nothing, but a covariance
  return config;
}

class DvlTest : public ::testing::Test {
 protected:
  template <typename Motion>
  std::vector<Measurement> Pings(const DvlConfig& config, const Motion& motion, double seconds,
                                 std::uint64_t seed = 1) const {
    Dvl dvl("dvl", 2, X_BS_, config, seed, environment_);
    return Watch(dvl, motion, kMs, std::llround(seconds * 1e9));
  }

  std::string Refusal(const DvlConfig& config) const {
    try {
      Dvl("dvl", 2, X_BS_, config, 1, environment_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  Bottom bottom_;
  Environment environment_{.step_ns = kMs, .surroundings = &bottom_};
  models::Pose X_BS_ = testing_sim::SlantedMounting();
};

TEST_F(DvlTest, ErrorsMatchTheGeometryAndTheDeliveredCovariance) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.noise_m_per_s = 0.01;
  for (const double angle : {22.5, 30.0}) {
    for (const int beams : {4, 3}) {
      config.beam_angle_deg = angle;
      // The beam towards +x +y is lost.
      bottom_.hides = [beams](const Vector3d& u) { return beams == 3 && u.x() > 0 && u.y() > 0; };
      const Steady steady{.v = {0.7, -0.4, 0.0}};
      std::array<std::vector<double>, 3> errors;
      double nis = 0.0;
      for (const Measurement& m : Pings(config, steady, 2000.0)) {
        const BodyVelocitySample sample = SampleOf(m);
        ASSERT_TRUE(sample.valid);
        EXPECT_EQ(sample.beams, beams == 4 ? 0b1111 : 0b1110);
        const Vector3d e = sample.v_WS_S - steady.v;
        for (int i = 0; i < 3; ++i) errors[i].push_back(e[i]);
        nis += e.dot(sample.covariance.llt().solve(e));
      }
      const std::size_t n = errors[0].size();
      ASSERT_GT(n, 19'990U);
      if (beams == 4) {
        const double across = 0.01 / (std::numbers::sqrt2 * std::sin(angle * kRad));
        const double up = 0.01 / (2.0 * std::cos(angle * kRad));
        for (int i = 0; i < 3; ++i) {
          const double sigma = i < 2 ? across : up;
          EXPECT_NEAR(testing_sim::Variance(errors[i]), sigma * sigma,
                      testing_sim::VarianceBand(sigma, n));
          EXPECT_NEAR(testing_sim::Mean(errors[i]), 0.0, testing_sim::MeanBand(sigma, n));
        }
      }
      EXPECT_NEAR(nis / static_cast<double>(n), 3.0, 5.0 * std::sqrt(6.0 / static_cast<double>(n)));
    }
  }
}

TEST_F(DvlTest, SaysWhatItsOwnOriginDoesBetweenPingAndEcho) {
  DvlConfig config = Quiet();
  config.altitude_max_m = 1000.0;
  config.max_incidence_deg = 90.0;
  const testing_sim::RoughRide ride;
  const auto out = Pings(config, ride, 20.0);
  ASSERT_GT(out.size(), 190U);
  DvlBeams beams("dvl", 30.0, {45, 135, 225, 315});
  const auto velocity_at = [&](double t) {  // of S in its axes, over the simulator's two steps
    const auto p = [&](double when) { return ride.At(when) * X_BS_.p; };
    const Vector3d v = (p(t + 1e-3) - p(t - 1e-3)) / 2e-3;
    return Vector3d((ride.At(t).R * X_BS_.R).transpose() * v);
  };
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double ping = 0.1 * static_cast<double>(n + 1);
    const models::Pose X_WS = ride.At(ping) * X_BS_;
    std::vector<std::optional<double>> along;
    double mean = 0.0, last = 0.0;
    for (const Vector3d& u : beams.directions()) {
      const Vector3d down = X_WS.R * u;
      const double range = (X_WS.p.z() + 10.0) / -down.z();
      const double echo = ping + 2.0 * range / kSoundSpeed;
      along.emplace_back(0.5 * u.dot(velocity_at(ping) + velocity_at(echo)));
      mean += range / 4.0;
      last = std::max(last, echo);
    }
    // Between two steps the velocity is interpolated: a tenth of a mm/s of a jerk of 100 m/s³.
    EXPECT_LT((SampleOf(out[n]).v_WS_S - beams.Solve(along, 1.0)->velocity_m_s).norm(), 1e-4);
    EXPECT_NEAR(models::Seconds(out[n].valid_ns), ping + mean / kSoundSpeed, 2e-9);
    EXPECT_NEAR(models::Seconds(out[n].arrival_ns), last + 0.02, 2e-9);
  }
}

TEST_F(DvlTest, IsInvalidWithoutLockAndNeverZero) {
  DvlConfig config = Quiet();
  config.altitude_max_m = 20.0;
  const Steady rising{.v = {0.0, 0.0, 1.0}};  // 10 m over the bottom at first
  int locked = 0, lost = 0;
  for (const Measurement& m : Pings(config, rising, 20.0)) {
    const BodyVelocitySample sample = SampleOf(m);
    // A slanted log: its beams pass 20 m one after the other.
    const double altitude = 10.0 + models::Seconds(m.valid_ns);
    EXPECT_TRUE(sample.valid || altitude > 14.0);
    EXPECT_TRUE(!sample.valid || altitude < 26.0);
    (sample.valid ? locked : lost) += 1;
    if (sample.valid) continue;
    EXPECT_LT(std::popcount(sample.beams), 3);
    EXPECT_TRUE(sample.v_WS_S.array().isNaN().all());
    EXPECT_TRUE(sample.covariance.array().isNaN().all());
  }
  EXPECT_GT(locked, 30);
  EXPECT_GT(lost, 30);
}

TEST_F(DvlTest, LosesBeamsByRangeIncidenceSpeedAndChance) {
  X_BS_ = {};
  const Steady still{.v = Vector3d::Zero()};
  const auto beams = [&](const DvlConfig& config, double seconds = 1.0) {
    double sum = 0.0, count = 0.0;
    for (const Measurement& m : Pings(config, still, seconds)) {
      sum += std::popcount(SampleOf(m).beams);
      count += 1.0;
    }
    return sum / count;
  };
  DvlConfig config = Quiet();
  EXPECT_EQ(beams(config), 4.0);
  config.altitude_min_m = 11.0;
  EXPECT_EQ(beams(config), 0.0);
  config.altitude_min_m = 9.0;
  config.max_incidence_deg = 29.0;  // they meet the bottom at 30°
  EXPECT_EQ(beams(config), 0.0);
  config.max_incidence_deg = 31.0;
  EXPECT_EQ(beams(config), 4.0);
  config.dropout = 0.25;
  EXPECT_NEAR(beams(config, 500.0), 3.0, 5.0 * std::sqrt(4 * 0.25 * 0.75 / 5000));
  config.dropout = 0.0;
  config.max_speed_m_s = 0.5;
  const auto fast = Pings(config, Steady{.v = {0.6, 0, 0}}, 1.0);
  EXPECT_FALSE(SampleOf(fast.at(0)).valid);
  config.max_speed_m_s = 0.7;
  EXPECT_TRUE(SampleOf(Pings(config, Steady{.v = {0.6, 0, 0}}, 1.0).at(0)).valid);
  config.min_beams = 4;
  bottom_.hides = [](const Vector3d& u) { return u.x() > 0 && u.y() > 0; };
  EXPECT_FALSE(SampleOf(Pings(config, still, 1.0).at(0)).valid);
  config.min_beams = 3;
  EXPECT_TRUE(SampleOf(Pings(config, still, 1.0).at(0)).valid);
}

TEST_F(DvlTest, TakesTheSoundsSpeedForWhatItIsNot) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.assumed_sound_speed_m_s = 1500.0;
  environment_.sound_speed_m_s = 1485.0;
  const Steady steady;
  const auto sample = SampleOf(Pings(config, steady, 1.0).at(0));
  EXPECT_LT((sample.v_WS_S - steady.v * 1500.0 / 1485.0).norm(), 1e-9);
}

TEST_F(DvlTest, ScaleAndOffsetsAreDrawnOnceARun) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.scale = 0.02;
  const Steady steady{.v = {1.0, 0.0, 0.0}};
  std::vector<double> scales, offsets;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    config.scale = 0.02;
    config.offset_m_per_s = 0.0;
    const auto out = Pings(config, steady, 0.35, seed);
    ASSERT_EQ(out.size(), 3U);
    EXPECT_NEAR(SampleOf(out[0]).v_WS_S.x(), SampleOf(out[2]).v_WS_S.x(), 1e-9);
    scales.push_back(SampleOf(out[0]).v_WS_S.x() - 1.0);
    config.scale = 0.0;
    config.offset_m_per_s = 0.02;
    offsets.push_back(SampleOf(Pings(config, steady, 0.15, seed).at(0)).v_WS_S.x() - 1.0);
  }
  EXPECT_NEAR(testing_sim::Variance(scales), 4e-4, testing_sim::VarianceBand(0.02, 1000));
  const double across = 0.02 / (std::numbers::sqrt2 * std::sin(30.0 * kRad));
  EXPECT_NEAR(testing_sim::Variance(offsets), across * across,
              testing_sim::VarianceBand(across, 1000));
}

TEST_F(DvlTest, PingsAsOftenAsItsAltitudeLets) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.timing.rate_hz = 12.5;
  config.rate_by_altitude = {{5, 20}, {20, 4}, {100, 2}};
  const auto period = [&](double depth) {
    bottom_.depth = depth;
    const auto out = Pings(config, Steady{.v = Vector3d::Zero()}, 5.0);
    return models::Seconds(out.at(4).valid_ns - out.at(3).valid_ns);
  };
  EXPECT_NEAR(period(4.0), 0.08, 1e-9);  // no more than rate_hz
  EXPECT_NEAR(period(15.0), 0.25, 1e-9);
  EXPECT_NEAR(period(50.0), 0.5, 1e-9);
  // Until the echo from 90 m is back no ping is sent: 104 m there and back at 1500 m/s.
  config.rate_by_altitude = {};
  EXPECT_NEAR(period(90.0), std::ceil(2000.0 * 90.0 / std::cos(30 * kRad) / 1500.0) * 1e-3, 1e-9);
}

TEST_F(DvlTest, OverWaterItSaysSo) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.altitude_max_m = 5.0;
  config.water_track = true;
  config.water_noise_m_per_s = 1e-12;
  Dvl dvl("dvl", 2, X_BS_, config, 1, environment_);
  const Steady steady;
  std::vector<Measurement> out;
  for (models::TimeNs t = 0; t <= 500 * kMs; t += kMs) {
    MotionWindow window = testing_sim::WindowAt(steady, t, kMs);
    window.water_velocity_m_s = {0.3, 0.1, 0.0};
    dvl.Observe(window, out);
  }
  ASSERT_GE(out.size(), 4U);
  for (const Measurement& m : out) {
    EXPECT_TRUE(SampleOf(m).valid);
    EXPECT_FALSE(SampleOf(m).over_ground);
    EXPECT_LT((SampleOf(m).v_WS_S - (steady.v - Vector3d(0.3, 0.1, 0.0))).norm(), 1e-9);
  }
}

TEST_F(DvlTest, FigureOfMeritIsTheBeamsContradiction) {
  X_BS_ = {};
  DvlConfig config = Quiet();
  config.noise_m_per_s = 0.01;
  double square = 0.0, count = 0.0;
  for (const Measurement& m : Pings(config, Steady{.v = {0.7, -0.4, 0.0}}, 500.0)) {
    square += std::pow(SampleOf(m).figure_of_merit_m_s, 2);
    count += 1.0;
  }
  // One number too many: a χ² of one degree of freedom times σ².
  EXPECT_NEAR(square / count, 1e-4, 5.0 * 1e-4 * std::sqrt(2.0 / count));
}

TEST_F(DvlTest, RefusesWhatNoLogIs) {
  EXPECT_EQ(Refusal(Quiet()), "");
  const auto refusal = [&](const std::function<void(DvlConfig&)>& change) {
    DvlConfig config = Quiet();
    change(config);
    return Refusal(config);
  };
  const auto names = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(names(refusal([](auto& c) { c.beam_angle_deg = 0; }), "beam_angle_deg"));
  EXPECT_TRUE(names(refusal([](auto& c) { c.azimuths_deg = {0, 90}; }), "azimuths_deg"));
  EXPECT_TRUE(names(refusal([](auto& c) { c.noise_m_per_s = 0; }), "noise_m_per_s"));
  EXPECT_TRUE(names(refusal([](auto& c) { c.altitude_max_m = 0.01; }), "altitude_max_m"));
  EXPECT_TRUE(names(refusal([](auto& c) { c.timing.rate_hz = 0; }), "rate_hz"));
  EXPECT_TRUE(names(refusal([](auto& c) { c.min_beams = 2; }), "min_beams"));
  EXPECT_TRUE(names(refusal([](auto& c) {
                      c.rate_by_altitude = {{5, 2}, {4, 2}};
                    }),
                    "rate_by_altitude"));
  environment_.surroundings = nullptr;
  EXPECT_EQ(Refusal(Quiet()), "sensor 'dvl': a Doppler log needs a sea around it");
}

TEST(DvlGrades, AreWhatADvlTakes) {
  const Bottom bottom;
  for (const DvlGrade& grade : DvlGrades()) {
    EXPECT_EQ(FindDvlGrade(grade.name), &grade);
    EXPECT_EQ(grade.config.grade, grade.name);
    EXPECT_NO_THROW(Dvl("dvl", 0, {}, grade.config, 1, {.surroundings = &bottom})) << grade.name;
    EXPECT_FALSE(grade.source.empty());
  }
  EXPECT_EQ(FindDvlGrade("a50")->config.beam_angle_deg, 22.5);
  EXPECT_EQ(FindDvlGrade("nothing"), nullptr);
}

}  // namespace
}  // namespace reckon::sim
