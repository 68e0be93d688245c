// Uses an installed reckon: reads a leg from a URDF, drives a filter with wheels, tells its belief.
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "reckon/estimator/imu_filter.h"
#include "reckon/estimator/registry.h"
#include "reckon/models/leg_kinematics.h"

namespace {

using reckon::estimator::Estimator;
using reckon::models::TimeNs;

constexpr TimeNs kMs = 1'000'000;

reckon::estimator::Setup Cart() {
  reckon::estimator::Setup setup;
  setup.suite.sensors = {{"imu", reckon::models::SensorKind::kImu, {}, 5 * kMs},
                         {"wheels", reckon::models::SensorKind::kEncoders, {}, 20 * kMs}};
  setup.suite.wheels = reckon::models::WheelDrive{"wheels", {0}, {1}, 0.2, 1.0, {}};
  setup.noise.gyro_noise_density_rad_per_s_sqrt_hz = 1e-4;
  setup.noise.accel_noise_density_m_per_s2_sqrt_hz = 2e-3;
  setup.noise.wheel_forward_m_per_s = 0.01;
  setup.noise.wheel_lateral_m_per_s = 0.01;
  setup.noise.wheel_vertical_m_per_s = 0.01;
  return setup;
}

/// Two seconds of rolling straight ahead at 1 m/s: both wheels of 0.2 m turn at 5 rad/s.
double SpeedAfterRolling(Estimator& filter) {
  reckon::estimator::Prior prior;
  prior.v_WB.x() = 0.9;  // the wheels know better
  prior.covariance.diagonal().setConstant(0.01);
  filter.Start(prior);
  for (TimeNs t = 5 * kMs; t <= 2000 * kMs; t += 5 * kMs) {
    reckon::models::ImuSample imu;
    imu.accel_m_s2.z() = 9.81;
    imu.interval_ns = 5 * kMs;
    bool good = filter.Process({0, t, t, imu}).refusal == reckon::estimator::Refusal::kNone;
    if (t % (20 * kMs) == 0) {
      reckon::models::EncoderSample wheels;
      wheels.angle_rad = Eigen::Vector2d::Zero();
      wheels.rate_rad_s = Eigen::Vector2d(5.0, 5.0);
      wheels.interval_ns = 20 * kMs;
      const auto report = filter.Process({1, t, t, wheels});
      good = good && report.corrections().size() == 1;
    }
    if (!good) throw std::runtime_error("a measurement was refused");
  }
  return filter.Belief()->v_WB.x();
}

/// A foot half a metre below a hip that turns about y, seen with the leg turned by a right angle.
Eigen::Vector3d FootOfALeg() {
  const auto robot = reckon::models::UrdfRobot::FromText(R"(
    <robot name="hopper"><link name="body"/><link name="foot"/><link name="leg"/>
      <joint name="hip" type="continuous">
        <parent link="body"/><child link="leg"/><axis xyz="0 1 0"/></joint>
      <joint name="ankle" type="fixed">
        <parent link="leg"/><child link="foot"/><origin xyz="0 0 -0.5"/></joint></robot>)");
  const std::array<std::string, 1> encoders{"hip"};
  const reckon::models::LegKinematics leg(robot, "foot", encoders);
  return leg.Evaluate(Eigen::Matrix<double, 1, 1>(std::acos(0.0))).p_BF;
}

}  // namespace

int main() {
  const reckon::estimator::Setup setup = Cart();
  const double by_name = SpeedAfterRolling(*reckon::estimator::FindEstimator("inekf")->make(setup));
  reckon::estimator::ImuFilter<reckon::estimator::MultiplicativeEkf> mekf(setup);
  const double by_type = SpeedAfterRolling(mekf);
  const Eigen::Vector3d foot = FootOfALeg();
  std::printf("speed %.2f %.2f m/s, foot %ld %ld %ld mm\n", by_name, by_type,
              std::lround(1e3 * foot.x()), std::lround(1e3 * foot.y()),
              std::lround(1e3 * foot.z()));
}
