#pragma once

#include <cmath>
#include <vector>

#include "estimator/carried_body.h"

namespace reckon::testing_estimator {

inline constexpr models::SensorId kDepthSensor = 4, kPoseSensor = 5;

/// The robot of TestSetup with a depth sensor and a position fix.
inline estimator::Setup PlanarSetup() {
  estimator::Setup setup = TestSetup();
  setup.suite.sensors.push_back({"depth", models::SensorKind::kDepth, {}, 100 * kMs});
  setup.suite.sensors.push_back({"pose", models::SensorKind::kPose, {}, 200 * kMs});
  setup.noise.depth_m = 0.05;
  return setup;
}

/// A wheeled body that drives curves on level ground without slip, with every sensor of
/// PlanarSetup, ideal but for the noise that a filter believes in.
class PlanarDrive : public CarriedBody {
 public:
  PlanarDrive(const estimator::Setup& setup, std::uint64_t seed) : CarriedBody(setup, seed) {
    x_.gyro_bias = draws_.Vector(1e-3);
    x_.accel_bias = draws_.Vector(2e-2);
    x_.p = p_BI();
    x_.v = VelocityOfI(0.0, w_);
  }

  /// 5 ms on; the IMU's sample, then those of the sensors whose turn it is.
  std::vector<Measurement> Advance() {
    std::vector<Measurement> due{Imu()};
    const auto now = [this](models::SensorId sensor) {
      return t_ns_ % setup_.suite.sensors[sensor].period_ns == 0;
    };
    if (now(kWheels)) due.push_back(Wheels());
    if (now(kVelocity)) due.push_back(Velocity());
    if (now(kDepthSensor)) {
      const double depth = -Body().p.z() + setup_.noise.depth_m * draws_.Normal();
      due.push_back({kDepthSensor, t_ns_, t_ns_, models::DepthSample{depth}});
    }
    if (now(kPoseSensor)) due.push_back(Fix());
    return due;
  }

 private:
  static double Speed(double t) { return 0.8 + 0.3 * std::sin(0.5 * t); }
  Eigen::Vector3d VelocityOfI(double t, const Eigen::Vector3d& w) const {
    return x_.R * (Eigen::Vector3d(Speed(t), 0, 0) + w.cross(p_BI()));
  }

  Measurement Imu() {
    const double t = models::Seconds(t_ns_) + kDt;
    const Eigen::Vector3d w(0, 0, 0.4 * std::sin(0.3 * t));
    const Eigen::Matrix3d R = x_.R;
    x_.R = R * estimator::Exp(w * kDt);  // of the velocity at the step's end
    const Eigen::Vector3d dv = VelocityOfI(t, w) - x_.v - gravity() * kDt;
    x_.R = R;
    return Carry(w, estimator::Gamma(1, w * kDt).inverse() * R.transpose() * dv / kDt);
  }

  Measurement Wheels() {
    const models::WheelDrive& drive = *setup_.suite.wheels;
    const double v = Speed(models::Seconds(t_ns_)), half = 0.5 * drive.effective_track_m * w_.z();
    const double noise = setup_.noise.wheel_forward_m_per_s;
    const double r = drive.rolling_radius_m;
    return WheelsAt(t_ns_, (v - half + noise * draws_.Normal()) / r,
                    (v + half + noise * draws_.Normal()) / r);
  }

  Measurement Velocity() {
    const models::Pose& X_BS = setup_.suite.sensors[kVelocity].X_BS;
    const Eigen::Vector3d v_B(Speed(models::Seconds(t_ns_)), 0, 0);
    return VelocityAt(t_ns_, X_BS.R.transpose() * (v_B + w_.cross(X_BS.p)) + draws_.Vector(0.02));
  }

  Measurement Fix() {
    models::PoseSample sample;
    sample.X_WS = {Body().R, Body().p + draws_.Vector(0.1)};
    sample.position_sigma_m = Eigen::Vector3d::Constant(0.1);
    return {kPoseSensor, t_ns_, t_ns_, sample};
  }
};

}  // namespace reckon::testing_estimator
