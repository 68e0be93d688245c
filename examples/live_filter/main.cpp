// The invariant filter on a live stream. Each line on stdin is one measurement, stamped in seconds:
//   imu T WX WY WZ AX AY AZ     rad/s and m/s² in the IMU's frame; it covers the time since the
//   last vel T VX VY VZ SIGMA        m/s over ground in the velocity sensor's frame, e.g. of a DVL
// It prints the belief after each velocity. Try it: live_filter < input.txt
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>

#include "reckon/estimator/registry.h"

namespace estimator = reckon::estimator;
namespace models = reckon::models;

int main() {
  // The robot as we believe it to be. A sensor's id is its place in this list.
  constexpr models::TimeNs kPeriod = 5'000'000;  // ns: an IMU at 200 Hz
  const models::Pose X_BV{.p = {0.3, 0.0, -0.1}};
  estimator::Setup setup;
  setup.suite.sensors = {{"imu", models::SensorKind::kImu, {}, kPeriod},
                         {"velocity", models::SensorKind::kBodyVelocity, X_BV, 50'000'000}};
  setup.noise.gyro_noise_density_rad_per_s_sqrt_hz = 1e-4;  // from the IMU's datasheet
  setup.noise.accel_noise_density_m_per_s2_sqrt_hz = 2e-3;
  setup.noise.gyro_bias_walk_rad_per_s2_sqrt_hz = 1e-5;
  setup.noise.accel_bias_walk_m_per_s3_sqrt_hz = 1e-4;
  const auto filter = estimator::FindEstimator("inekf")->make(setup);

  estimator::Prior prior;  // at the origin, level and at rest at t = 0, give or take
  estimator::ErrorVector sigma;
  sigma << 0.02, 0.02, 0.01, 0.05, 0.05, 0.05, 0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3, 0.02, 0.02, 0.02;
  prior.covariance = sigma.cwiseAbs2().asDiagonal();
  filter->Start(prior);

  for (std::string line, kind; std::getline(std::cin, line);) {
    std::istringstream words(line);
    double t_s = 0.0, noise = 0.0;
    models::ImuSample imu{.interval_ns = kPeriod};
    models::BodyVelocitySample vel;
    Eigen::Vector3d &w = imu.gyro_rad_s, &a = imu.accel_m_s2, &v = vel.v_WS_S;
    words >> kind >> t_s;
    if (kind == "imu") words >> w.x() >> w.y() >> w.z() >> a.x() >> a.y() >> a.z();
    if (kind == "vel") words >> v.x() >> v.y() >> v.z() >> noise;
    if (!words || (kind != "imu" && kind != "vel")) continue;
    vel.covariance = noise * noise * Eigen::Matrix3d::Identity();
    const auto t_ns = static_cast<models::TimeNs>(t_s * 1e9 + 0.5);  // valid, and here at once
    const auto report = kind == "imu" ? filter->Process({0, t_ns, t_ns, imu})
                                      : filter->Process({1, t_ns, t_ns, vel});

    if (report.refusal != estimator::Refusal::kNone) {  // the filter goes on as if it never came
      std::cerr << kind << " at " << t_s << " s refused: " << Name(report.refusal) << "\n";
    }
    for (const auto& correction : report.corrections()) {  // NIS: three on average if all is well
      std::cout << Name(correction.decision) << " NIS " << correction.nis;
      if (const auto x = filter->Belief()) {
        std::cout << " p " << x->X_WB.p.transpose() << " v " << x->v_WB.transpose();
      }
      std::cout << "\n";
    }
  }
}
