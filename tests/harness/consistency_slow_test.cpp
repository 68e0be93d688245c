// Whether a covariance that is honest passes, whether one that is not fails, and how honest the
// filters are on real ground.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <iostream>
#include <numbers>
#include <sstream>

#include "harness/seeds.h"
#include "reckon/ground_truth/consistency.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

using ground_truth::Track;

constexpr int kSeeds = 50;
constexpr int kTimes = 10;
constexpr double kFalseAlarm = 1e-6;  ///< of a whole gate

/// What many runs say of one estimator: NEES per block (a row a seed, a column a time), and the
/// innovations of the velocity sensor.
struct Evidence {
  std::array<Eigen::MatrixXd, ground_truth::kNeesBlocks> nees;
  double nis_sum = 0.0;
  double nis_count = 0.0;
  double lag_sum = 0.0;  ///< Σ whitened_k · whitened_{k+1}
  double lag_count = 0.0;
};

void Collect(const Track& track, int seed, Evidence& evidence) {
  for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
    auto& nees = evidence.nees[static_cast<std::size_t>(block)];
    if (nees.size() == 0) nees.resize(kSeeds, kTimes);
    nees.row(seed - 1) = NeesAtTimes(track, block, kTimes);
  }
  const auto& corrections = track.corrections();
  for (std::size_t k = 0; k < corrections.size(); ++k) {
    evidence.nis_sum += corrections[k].nis;
    evidence.nis_count += 1.0;
    if (k == 0) continue;
    evidence.lag_sum += corrections[k].whitened.dot(corrections[k - 1].whitened);
    evidence.lag_count += 3.0;
  }
}

/// What is dishonest about an estimator; empty if nothing is. The false alarm is split evenly over
/// all blocks and times, the mean NIS and its whiteness.
std::vector<std::string> Complaints(const Evidence& evidence) {
  const double each = kFalseAlarm / (ground_truth::kNeesBlocks + 2);
  std::vector<std::string> complaints;
  for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
    const auto anees = ground_truth::AneesOf(evidence.nees[static_cast<std::size_t>(block)],
                                             ground_truth::NeesDof(block), each);
    if (anees.holds()) continue;
    std::ostringstream text;
    text << "ANEES " << ground_truth::NeesBlockName(block) << " " << anees.mean.transpose()
         << " outside " << anees.bounds.lower << " … " << anees.bounds.upper;
    complaints.push_back(text.str());
  }
  const double mean = evidence.nis_sum / evidence.nis_count;
  const auto bounds = ground_truth::ChiSquareMeanBounds(3.0, evidence.nis_count, each);
  if (!bounds.Contains(mean)) {
    std::ostringstream text;
    text << "mean NIS " << mean << " outside " << bounds.lower << " … " << bounds.upper;
    complaints.push_back(text.str());
  }
  const double lag = evidence.lag_sum / evidence.lag_count;
  if (std::abs(lag) > 5.0 / std::sqrt(evidence.lag_count)) {
    complaints.push_back("innovations are not white: lag-1 correlation " + std::to_string(lag));
  }
  return complaints;
}

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
  std::map<std::string, Evidence> evidence;
  ForSeeds(WithDefects(), kSeeds, [&](int seed, const auto& tracks) {
    for (const auto& [name, track] : tracks) Collect(track, seed, evidence[name]);
  });
  for (const auto& [name, found] : evidence) {
    const auto complaints = Complaints(found);
    std::string text;
    for (const auto& complaint : complaints) text += "\n    " + complaint;
    const bool honest = name == "ideal" || name == "mekf";
    EXPECT_EQ(complaints.empty(), honest) << name << text;
    std::cout << name << ": mean NIS " << found.nis_sum / found.nis_count << ", "
              << complaints.size() << " complaints" << text << "\n";
  }
}

}  // namespace
}  // namespace reckon::harness
