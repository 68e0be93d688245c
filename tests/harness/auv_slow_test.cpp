// Whether the filters are honest under water, which mistakes their covariance gives away, and which
// of two filters is the better one there.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "harness/evidence.h"
#include "reckon/harness/yaml_reader.h"

namespace reckon::harness {
namespace {

constexpr int kSeeds = 50;
constexpr double kFalseAlarm = 1e-6;  ///< of a whole gate

/// The nominal mission, and beside its honest filters one with each defect.
Scenario WithDefects() {
  Scenario scenario = ReadScenario(std::string(RECKON_SOURCE_DIR) + "/tests/harness/data/auv.yaml");
  const EstimatorConfig ideal = scenario.estimators.at("ideal");
  const auto add = [&](const std::string& name) -> EstimatorConfig& {
    return scenario.estimators[name] = ideal;
  };
  add("turned_dvl").mounting_error["dvl"] = {0, 0, 0, 2, 0, 0};
  const models::Suite suite = LoadRobot(scenario).nominal;
  const models::Pose& X_BS = suite.sensors[*suite.Find("dvl")].X_BS;
  const Eigen::Vector3d twice = -2.0 * X_BS.p;  // the lever arm with the other sign
  add("lever_arm_sign").mounting_error["dvl"] = {twice.x(), twice.y(), twice.z(), 0, 0, 0};
  add("dvl_noise").noise.body_velocity_scale = 0.1;
  return scenario;
}

TEST(AuvConsistency, PassesHonestFiltersAndFailsEachDefect) {
  ExpectHonest({"ideal", "mekf"}, EvidenceOf(WithDefects(), kSeeds), kFalseAlarm);
}

TEST(AuvConsistency, FailsADepthWithTheOtherSign) {
  Scenario scenario = WithDefects();
  // A fault that turns the sensor's sign; the filters are not told.
  scenario.faults.push_back({.sensor = "pressure",
                             .kind = sim::FaultKind::kScaleStep,
                             .at_s = 0.0,
                             .for_s = 1e5,
                             .magnitude = -1.0});
  scenario.estimators = {{"ideal", scenario.estimators.at("ideal")}};
  const auto evidence = EvidenceOf(scenario, kSeeds);
  EXPECT_FALSE(evidence.at("ideal").Complaints(kFalseAlarm).empty());
}

/// Paired differences of a score over seeds, as the logarithm of a ratio.
struct Paired {
  std::vector<double> log_ratio;

  double mean() const {
    double sum = 0.0;
    for (const double x : log_ratio) sum += x;
    return sum / static_cast<double>(log_ratio.size());
  }
  /// Half the width of the 95 % interval of the mean (50 seeds: Student's t of 49, 2.01).
  double half_width() const {
    double square = 0.0;
    for (const double x : log_ratio) square += (x - mean()) * (x - mean());
    const auto n = static_cast<double>(log_ratio.size());
    return 2.01 * std::sqrt(square / (n - 1.0) / n);
  }
};

double RmsOf(const ground_truth::Track& track,
             const std::function<double(const ground_truth::TrackSample&)>& error) {
  double square = 0.0;
  for (const auto& sample : track.samples()) square += std::pow(error(sample), 2);
  return std::sqrt(square / static_cast<double>(track.samples().size()));
}

double Position(const ground_truth::TrackSample& s) { return (s.X_WB.p - s.X_WB_true.p).norm(); }

/// The angle between the two verticals.
double Tilt(const ground_truth::TrackSample& s) {
  return std::acos(std::min(1.0, s.X_WB.R.row(2).dot(s.X_WB_true.R.row(2))));
}

/// Errors of the invariant filter over those of the multiplicative one, in DRIFT's experiment.
std::map<std::string, Paired> InvariantOverMultiplicative(
    const std::vector<std::string>& overrides) {
  const Scenario scenario = ReadScenario(
      std::string(RECKON_SOURCE_DIR) + "/scenarios/auv/drift_experiment.yaml", overrides);
  std::map<std::string, Paired> paired;
  ForSeeds(scenario, kSeeds, [&](int, const auto& tracks) {
    const auto add = [&](const char* name, const auto& error) {
      paired[name].log_ratio.push_back(
          std::log(RmsOf(tracks.at("riekf"), error) / RmsOf(tracks.at("mekf"), error)));
    };
    add("position", Position);
    add("tilt", Tilt);
  });
  for (const auto& [name, ratio] : paired) {
    std::cout << name << ": " << std::exp(ratio.mean()) << " times, 95 % between "
              << std::exp(ratio.mean() - ratio.half_width()) << " and "
              << std::exp(ratio.mean() + ratio.half_width()) << "\n";
  }
  return paired;
}

/// Half a radian of attitude, and half a metre a second.
std::vector<std::string> LargeErrors(const std::string& gate) {
  return {"initial.sigma.roll_pitch_rad=0.35", "initial.sigma.yaw_rad=0.35",
          "initial.sigma.velocity_m_s=0.5", "estimators.riekf.gate.action=" + gate,
          "estimators.mekf.gate.action=" + gate};
}

// DRIFT (section VI-F) finds its invariant filter slightly better in position, roll and pitch, on
// one run. Near the truth both filters are one to first order: no difference is left over 50 seeds.
TEST(DriftExperiment, NearTheTruthBothFiltersAreOne) {
  const auto paired = InvariantOverMultiplicative({});
  for (const auto& [name, ratio] : paired) {
    EXPECT_LT(std::abs(ratio.mean()), 0.05) << name;  // 5 %
    EXPECT_LT(ratio.half_width(), 0.05) << name << ": the seeds can tell";
  }
}

// Far from it the claim holds by much: the invariant error propagates linearly whatever its size.
TEST(DriftExperiment, FarFromTheTruthTheInvariantFilterIsBetter) {
  for (const char* gate : {"reject", "off"}) {
    std::cout << "gate: " << gate << "\n";
    for (const auto& [name, ratio] : InvariantOverMultiplicative(LargeErrors(gate))) {
      EXPECT_LT(ratio.mean() + ratio.half_width(), std::log(0.9)) << name << ", gate " << gate;
    }
  }
}

}  // namespace
}  // namespace reckon::harness
