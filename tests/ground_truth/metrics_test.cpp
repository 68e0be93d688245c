#include "reckon/ground_truth/metrics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "ground_truth/tracks.h"

namespace reckon::ground_truth {
namespace {

using testing::LineTrack;

const std::vector<std::string> kSensors{"imu", "wheels"};

/// 100 m straight ahead at 1 m/s; the estimate runs 1 % short.
Track ShortLine() {
  return LineTrack(101, [](int k) { return Eigen::Vector3d(-0.01 * k, 0.0, 0.0); });
}

TEST(Score, OfAnEstimateThatRunsShort) {
  const Metrics metrics = Score(ShortLine(), kSensors, ScoreOptions());
  // Errors 0, 0.01, … 1.00: mean 0.5, mean square 0.01² · 100 · 201 / 6.
  EXPECT_NEAR(metrics.Find("ate_position_mean_m").value(), 0.5, 1e-12);
  EXPECT_NEAR(metrics.Find("ate_position_rmse_m").value(), 0.01 * std::sqrt(100 * 201 / 6.0),
              1e-12);
  EXPECT_NEAR(metrics.Find("ate_position_sse_m2").value(), 1e-4 * 101 * 100 * 201 / 6.0, 1e-10);
  EXPECT_NEAR(metrics.Find("ate_position_max_m").value(), 1.0, 1e-12);
  EXPECT_NEAR(metrics.Find("rpe_1m_translation_rmse").value(), 0.01, 1e-12);
  EXPECT_NEAR(metrics.Find("rpe_1m_rotation_rmse_deg").value(), 0.0, 1e-12);
  EXPECT_NEAR(metrics.Find("rpe_10m_translation_max").value(), 0.1, 1e-12);
  EXPECT_NEAR(metrics.Find("rpe_10s_translation_max_m").value(), 0.1, 1e-12);
  EXPECT_NEAR(metrics.Find("final_drift_m").value(), 1.0, 1e-12);
  EXPECT_NEAR(metrics.Find("final_drift_percent").value(), 1.0, 1e-12);
  EXPECT_NEAR(metrics.Find("path_length_m").value(), 100.0, 1e-12);
  EXPECT_EQ(metrics.Find("estimate_count"), 101.0);
  EXPECT_TRUE(metrics.valid());
}

TEST(Score, LeavesOutWhatDoesNotApplyAndStaysValid) {
  const Metrics metrics = Score(ShortLine(), kSensors, ScoreOptions());  // no covariance, no biases
  EXPECT_FALSE(metrics.Find("nees_position_mean"));
  EXPECT_FALSE(metrics.Find("gyro_bias_error_rmse_rad_s"));
  EXPECT_FALSE(metrics.Find("nis_wheels_mean"));
  EXPECT_TRUE(metrics.valid());
  const Metrics standing =
      Score(LineTrack(1, [](int) { return Eigen::Vector3d::Zero(); }), kSensors, ScoreOptions());
  EXPECT_FALSE(standing.Find("final_drift_percent"));
}

TEST(Score, StartsWhereItIsTold) {
  Track track = ShortLine();
  track.DropBefore(50 * models::kNsPerSecond);
  const Metrics metrics = Score(track, kSensors, ScoreOptions());
  EXPECT_EQ(metrics.Find("estimate_count"), 51.0);
  EXPECT_NEAR(metrics.Find("ate_position_max_m").value(), 0.5, 1e-12);  // aligned at its first pose
}

TEST(Score, NamesMetricsByTheirLengthsAndSensors) {
  ScoreOptions options;
  options.rpe_m = {0.5, 25.0};
  options.rpe_s = {};
  const Metrics metrics = MetricCatalogue({"dvl"}, options);
  std::set<std::string> names;
  for (const Metric& metric : metrics.list()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name << " twice";
    EXPECT_FALSE(metric.unit.empty() || metric.meaning.empty()) << metric.name;
  }
  for (const char* name : {"rpe_0p5m_translation_rmse", "rpe_25m_rotation_rmse_deg", "nis_dvl_mean",
                           "rejected_dvl_count", "refused_dvl_late_count"}) {
    EXPECT_TRUE(names.count(name)) << name;
  }
  EXPECT_FALSE(names.count("rpe_1m_translation_rmse"));
}

TEST(Score, GivesThePlanOfItsCatalogueWhateverTheRun) {
  const Metrics full = Score(ShortLine(), kSensors, ScoreOptions());
  const Metrics none = MetricCatalogue(kSensors, ScoreOptions());
  ASSERT_EQ(full.list().size(), none.list().size());
  for (std::size_t i = 0; i < full.list().size(); ++i) {
    EXPECT_EQ(full.list()[i].name, none.list()[i].name);
  }
  EXPECT_FALSE(none.valid());  // a run without estimates has scores that are missing
}

TEST(Score, OfATruthThatIsNoNumberIsInvalid) {
  Track track;
  Truth truth;
  truth.X_WB.p.setConstant(std::nan(""));
  for (int k = 0; k < 100; ++k) {
    truth.t_ns = k * models::kNsPerSecond;
    estimator::Estimate estimate;
    estimate.t_ns = truth.t_ns;
    track.Add(truth, estimate);
  }
  for (const Alignment align : {Alignment::kFirstPose, Alignment::kSe3, Alignment::kYawPosition}) {
    ScoreOptions options;
    options.align = align;
    const Metrics metrics = Score(track, kSensors, options);
    EXPECT_FALSE(metrics.Find("ate_position_rmse_m"));
    EXPECT_FALSE(metrics.valid());
  }
}

TEST(ToJson, WritesNullForWhatIsNoNumber) {
  Metrics metrics;
  metrics.Add({"a_m", 0.1, true, "m", ""});
  metrics.Add({"b_count", 12.0, true, "count", ""});
  metrics.Add({"c", std::nan(""), false, "1", ""});
  EXPECT_EQ(ToJson(metrics).dump(), R"({"valid":true,"a_m":0.1,"b_count":12,"c":null})");
  metrics.Add({"d", INFINITY, true, "1", ""});
  EXPECT_EQ(ToJson(metrics).dump(), R"({"valid":false,"a_m":0.1,"b_count":12,"c":null,"d":null})");
}

}  // namespace
}  // namespace reckon::ground_truth
