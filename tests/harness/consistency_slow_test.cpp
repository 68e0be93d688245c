// Whether a covariance that is honest passes, whether one that is not fails, and how honest the
// filters are on real ground.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "harness/evidence.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

constexpr int kSeeds = 50;
constexpr double kFalseAlarm = 1e-6;  ///< of a whole gate

/// The rotation vector [deg] that turns `R` into what a reader of the wrong quaternion order
/// (x, y, z, w taken for w, x, y, z) makes of it.
Eigen::Vector3d SwappedOrder(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const Eigen::Quaterniond swapped(q.x(), q.y(), q.z(), q.w());
  const Eigen::AngleAxisd turn(swapped.toRotationMatrix() * R.transpose());
  return turn.axis() * (turn.angle() * 180.0 / std::numbers::pi);
}

/// The ideal scenario, and beside its honest filters one with each defect.
Scenario WithDefects() {
  Scenario scenario =
      ReadScenario(std::string(RECKON_SOURCE_DIR) + "/tests/harness/data/ideal.yaml");
  const EstimatorConfig ideal = scenario.estimators.at("ideal");
  const double tenth = std::sqrt(0.1);  // of a variance
  const auto add = [&](const std::string& name) -> EstimatorConfig& {
    return scenario.estimators[name] = ideal;
  };
  add("gyro_variance").noise.gyro_noise_density_rad_per_s_sqrt_hz *= tenth;
  add("accel_variance").noise.accel_noise_density_m_per_s2_sqrt_hz *= tenth;
  add("velocity_variance").noise.body_velocity_scale *= tenth;
  add("late_stamps").sensors = {"imu", "stale"};
  add("lever_arm").mounting_error["velocity"] = {0, 0.1, 0, 0, 0, 0};
  const models::Suite suite = LoadRobot(scenario).nominal;
  const Eigen::Vector3d swap = SwappedOrder(suite.sensors[*suite.Find("velocity")].X_BS.R);
  add("quaternion_order").mounting_error["velocity"] = {0, 0, 0, swap.x(), swap.y(), swap.z()};
  return scenario;
}

TEST(ConsistencyGate, PassesHonestFiltersAndFailsEachDefect) {
  ExpectHonest({"ideal", "mekf"}, EvidenceOf(WithDefects(), kSeeds), kFalseAlarm);
}

}  // namespace
}  // namespace reckon::harness
