// Forces from torques, on a leg of the Mini Cheetah's class whose torques follow from a motion and
// a force that the test makes up.
#include "reckon/estimator/leg_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace reckon::estimator {
namespace {

using Eigen::Vector3d;
using models::LegVector;

class LegLoads : public ::testing::Test {
 protected:
  static LegVector Angles(double t) {
    return Vector3d(0.1 * std::sin(3 * t), 0.8 + 0.3 * std::sin(9 * t),
                    -1.6 + 0.5 * std::cos(7 * t));
  }
  static LegVector Rates(double t) {
    return Vector3d(0.3 * std::cos(3 * t), 2.7 * std::cos(9 * t), -3.5 * std::sin(7 * t));
  }
  static LegVector Accelerations(double t) {
    return Vector3d(-0.9 * std::sin(3 * t), -24.3 * std::sin(9 * t), -24.5 * std::cos(7 * t));
  }

  /// The reading of a leg on which `force` acts.
  LegReading At(double t, const Vector3d& force) const {
    LegReading reading{Angles(t), Rates(t), {}, body_};
    const auto foot = Foot(t);
    reading.torque_n_m = dynamics_.InverseDynamics(reading.q, reading.dq, Accelerations(t), body_) -
                         foot.J.transpose() * force;
    return reading;
  }
  models::FootPosition Foot(double t) const {
    models::EncoderVector all = models::EncoderVector::Zero(12);
    const LegVector q = Angles(t);
    for (int k = 0; k < 3; ++k) all[kinematics_.entries()[static_cast<std::size_t>(k)]] = q[k];
    return kinematics_.Evaluate(all);
  }

  /// The largest error [N] over a second in which the foot is pressed from 0.4 s on, but for the
  /// 60 ms after that; the filter steps at `rate_hz`.
  double WorstError(const ContactDetection& told, double rate_hz) const {
    LegLoad load;
    double worst = 0.0;
    for (int k = 0; k < static_cast<int>(rate_hz); ++k) {
      const double t = k / rate_hz;
      const Vector3d force = t < 0.4 ? Vector3d::Zero() : Vector3d(3, -2, 45);
      const Vector3d found =
          load.Force(At(t, force), k == 0 ? 0.0 : 1.0 / rate_hz, told, Foot(t), dynamics_);
      if (t > 0.1 && (t < 0.4 || t > 0.46)) worst = std::max(worst, (found - force).norm());
    }
    return worst;
  }

  const models::UrdfRobot urdf_ =
      models::UrdfRobot::FromFile(RECKON_SOURCE_DIR "/models/mini_cheetah/mini_cheetah.urdf");
  const std::vector<std::string> joints_{"FR_abad", "FR_hip", "FR_knee"};
  const std::vector<double> armature_{0.0023, 0.0023, 0.0055};
  const models::LegKinematics kinematics_{urdf_, "FR_foot", joints_};
  const models::LegDynamics dynamics_{urdf_, "FR_foot", joints_, armature_};
  const models::BodyMotion body_{{0.2, -0.1, 0.3}, Vector3d::Zero(), {0.5, 0.2, 9.9}};
};

TEST_F(LegLoads, InertiaFindsTheForceUpToItsDifferences) {
  // q̈ by difference is that of half a step earlier: 1 ms of a jerk of 9³ · 0.3 and 7³ · 0.5 rad/s³,
  // through inertias of up to 0.02 kg m² and a lever of 0.1 m at least, is below 0.1 N.
  EXPECT_LT(WorstError({.sensor = "", .force = ForceModel::kInertia}, 500), 0.1);
}

TEST_F(LegLoads, MomentumFollowsItThroughOnePole) {
  // The pole lags by 5.3 ms while the lever turns at up to 4.5 rad/s: 45 N · 4.5 · 5.3e-3 = 1.1 N.
  // Of the step itself e^(−2π · 30 · 0.06) = 1.2e-5 is left.
  EXPECT_LT(WorstError({.sensor = "", .force = ForceModel::kMomentum, .observer_hz = 30}, 500),
            1.1);
  LegLoad load;
  double at_pole = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double t = k * 1e-3;
    const Vector3d force(0, 0, t < 0.4 ? 0.0 : 40.0);
    const Vector3d found = load.Force(
        At(t, force), k == 0 ? 0.0 : 1e-3,
        {.sensor = "", .force = ForceModel::kMomentum, .observer_hz = 30}, Foot(t), dynamics_);
    if (k == 405) at_pole = found.z();
  }
  // 6 samples of 1 ms after the step: 1 − e^(−2π · 30 · 0.006) of it.
  EXPECT_NEAR(at_pole, 40.0 * (1 - std::exp(-2 * std::numbers::pi * 30 * 0.006)), 1.0);
}

TEST_F(LegLoads, StaticMissesWhatTheMotionTakes) {
  // The negative control of InertiaFindsTheForce: the knee's armature alone takes
  // 0.0055 kg m² · 24.5 rad/s² over a lever of 0.2 m, 0.7 N that are no contact.
  EXPECT_GT(WorstError({.sensor = "", .force = ForceModel::kStatic}, 500), 0.5);
}

TEST_F(LegLoads, AreExactAtRest) {
  const LegVector q = Angles(0.3), none = LegVector::Zero(3);
  const Vector3d force(1, 2, 30);
  const models::BodyMotion rest{.specific_force_m_s2 = {0, 0, 9.81}};
  LegReading reading{q, none, {}, rest};
  reading.torque_n_m =
      dynamics_.InverseDynamics(q, none, none, rest) - Foot(0.3).J.transpose() * force;
  for (const ForceModel model :
       {ForceModel::kStatic, ForceModel::kInertia, ForceModel::kMomentum}) {
    LegLoad load;
    Vector3d found = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      found = load.Force(reading, 0.002 * k, {.sensor = "", .force = model}, Foot(0.3), dynamics_);
    }
    // The term that keeps a stretched leg finite: 1e-6 m² beside (0.1 m)² at least.
    EXPECT_LT((found - force).norm(), 2e-4 * force.norm());
  }
}

}  // namespace
}  // namespace reckon::estimator
