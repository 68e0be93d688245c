// What one part of a scenario must not change in another, and what `record:` leaves out.

#include <gtest/gtest.h>

#include "harness/run_case.h"

namespace reckon::harness {
namespace {

using testing::BusyScenario;
using testing::Bytes;
using testing::EstimateStreams;
using testing::MeasurementStreams;
using testing::RunIn;
using testing::Streams;
using testing::TemporaryFolder;

const std::vector<std::string> kTwoMoreSensors{
    "sensors.a_velocity={type: body_velocity, frame: base_link, noise_m_per_s: [0.1, 0.1, 0.1]}",
    "sensors.second_imu={type: imu, frame: imu_link, grade: vn100, rate_hz: 100}"};

TEST(Independence, AnotherSensorLeavesTheOthersMeasurementsAsTheyWere) {
  const TemporaryFolder folder;
  const Streams before = MeasurementStreams(RunIn(folder / "a", BusyScenario()) / "recording.h5");
  const Streams after =
      MeasurementStreams(RunIn(folder / "b", BusyScenario(kTwoMoreSensors)) / "recording.h5");
  ASSERT_EQ(before.size(), 2U);
  ASSERT_EQ(after.size(), 4U);
  EXPECT_GT(after.at("second_imu").size(), 190U);
  EXPECT_GT(after.at("a_velocity").size(), 35U);
  for (const auto& [sensor, rows] : before) {
    EXPECT_GT(rows.size(), 90U);
    EXPECT_TRUE(after.at(sensor) == rows) << sensor;
  }
}

TEST(Independence, AFaultStrikesItsSensorAlone) {
  const TemporaryFolder folder;
  const Streams before = MeasurementStreams(RunIn(folder / "a", BusyScenario()) / "recording.h5");
  const auto faulty = BusyScenario({"faults=[{sensor: wheels, kind: stuck, at_s: 0.5}]"});
  const Streams after = MeasurementStreams(RunIn(folder / "b", faulty) / "recording.h5");
  EXPECT_FALSE(after.at("wheels") == before.at("wheels"));

  // The IMU has lost its outliers and nothing else: samples valid in [1, 1.2) s could have them.
  const auto& with = before.at("imu");
  const auto& without = after.at("imu");
  ASSERT_EQ(with.size(), without.size());
  int differ = 0;
  for (std::size_t k = 0; k < with.size(); ++k) differ += with[k] != without[k] ? 1 : 0;
  EXPECT_GT(differ, 0);
  EXPECT_LE(differ, 40);
}

TEST(Independence, ASensorThatAnEstimatorIsNotGivenDoesNotMatterToIt) {
  const TemporaryFolder folder;
  const std::string restrict = "estimators.riekf.sensors=[imu, wheels]";
  const std::string add = kTwoMoreSensors[0];
  const Streams before =
      EstimateStreams(RunIn(folder / "a", BusyScenario({restrict})) / "recording.h5");
  const Streams after =
      EstimateStreams(RunIn(folder / "b", BusyScenario({restrict, add})) / "recording.h5");
  EXPECT_GT(before.at("riekf").size(), 300U);
  EXPECT_TRUE(after.at("riekf") == before.at("riekf"));
  EXPECT_FALSE(after.at("mekf") == before.at("mekf"));  // it is given all
}

TEST(Independence, AnotherEstimatorLeavesTheOthersAsTheyWere) {
  const TemporaryFolder folder;
  const Streams before = EstimateStreams(RunIn(folder / "a", BusyScenario()) / "recording.h5");
  const auto more = BusyScenario({"estimators.another={type: mekf, noise: matched}"});
  const auto recording = RunIn(folder / "b", more) / "recording.h5";
  Streams after = EstimateStreams(recording);
  EXPECT_EQ(after.erase("another"), 1U);
  EXPECT_TRUE(after == before);
}

struct Counts {
  int truth = 0, measurements = 0, estimates = 0, covariances = 0, corrections = 0;
  bool operator==(const Counts&) const = default;
};

/// Rows in a recording; estimates and corrections are those of the riekf.
Counts CountRows(const std::filesystem::path& recording) {
  const ground_truth::RecordingReader reader(recording);
  std::size_t riekf = 0;
  while (reader.estimators()[riekf] != "riekf") ++riekf;
  Counts counts;
  for (auto rows = reader.ReadTruth(); rows.Next();) ++counts.truth;
  for (auto rows = reader.ReadMeasurements(); rows.Next();) ++counts.measurements;
  for (auto rows = reader.ReadCorrections(riekf); rows.Next();) ++counts.corrections;
  for (auto rows = reader.ReadEstimates(riekf); const auto row = rows.Next();) {
    ++counts.estimates;
    counts.covariances += row->covariance.isZero(0.0) ? 0 : 1;
  }
  return counts;
}

class Record : public ::testing::Test {
 protected:
  /// Runs with one key of `record:` changed; the scores must stay the same, but for where they
  /// are sampled.
  Counts With(const std::string& key) {
    const auto result = RunIn(folder_ / "changed", BusyScenario({"record." + key}));
    const auto whole = RunIn(folder_ / "whole", BusyScenario());
    EXPECT_TRUE(Bytes(result / "metrics.json") == Bytes(whole / "metrics.json")) << key;
    all_ = CountRows(whole / "recording.h5");
    return CountRows(result / "recording.h5");
  }

  TemporaryFolder folder_;
  Counts all_;
};

TEST_F(Record, EverythingAtFullRateUnlessToldOtherwise) {
  const Counts counts = CountRows(RunIn(folder_.path(), BusyScenario()) / "recording.h5");
  EXPECT_EQ(counts.truth, 2001);             // t = 0 … 2 s at 1 kHz
  EXPECT_NEAR(counts.measurements, 500, 2);  // 200 Hz and 50 Hz for 2 s, less the last's latency
  EXPECT_NEAR(counts.estimates, 400, 2);     // one an IMU sample
  EXPECT_EQ(counts.covariances, counts.estimates);
  EXPECT_GT(counts.corrections, 90);
}

TEST_F(Record, StreamsCanBeSwitchedOff) {
  Counts counts = With("truth=false");
  Counts expected = all_;
  expected.truth = 0;
  EXPECT_EQ(counts, expected);

  counts = With("measurements=false");
  expected = all_;
  expected.measurements = 0;
  EXPECT_EQ(counts, expected);

  counts = With("estimates=false");
  expected = all_;
  expected.estimates = expected.covariances = 0;
  EXPECT_EQ(counts, expected);

  counts = With("covariance=false");
  expected = all_;
  expected.covariances = 0;
  EXPECT_EQ(counts, expected);

  counts = With("innovations=false");
  expected = all_;
  expected.corrections = 0;
  EXPECT_EQ(counts, expected);
}

TEST_F(Record, RatesCanBeLowered) {
  EXPECT_EQ(With("truth_rate_hz=50").truth, 101);  // every 20 ms in [0, 2] s

  // Without the faults: jitter takes the stamps of the odometry off the grid.
  const auto result =
      RunIn(folder_.path(), BusyScenario({"faults=[]", "record.estimate_rate_hz=25"}));
  const ground_truth::RecordingReader reader(result / "recording.h5");
  for (std::size_t i = 0; i < reader.estimators().size(); ++i) {
    int rows = 0;
    for (auto cursor = reader.ReadEstimates(i); const auto row = cursor.Next(); ++rows) {
      EXPECT_EQ(row->t_ns % 40'000'000, 0) << reader.estimators()[i];
    }
    EXPECT_NEAR(rows, 50, 1) << reader.estimators()[i];
  }
}

TEST_F(Record, AFileExplainsItself) {
  const auto result = RunIn(folder_.path(), BusyScenario());
  const ground_truth::RecordingReader reader(result / "recording.h5");
  EXPECT_TRUE(reader.closed());
  const auto says = [&reader](const std::string& attribute, const std::string& what) {
    return reader.Attribute(attribute).value_or("").find(what) != std::string::npos;
  };
  EXPECT_TRUE(says("frames", "W: world, z up"));
  EXPECT_TRUE(says("time", "nanoseconds"));
  EXPECT_TRUE(says("error_order", "orientation, velocity, position"));
  EXPECT_TRUE(says("error_right_invariant", "Log"));
  EXPECT_TRUE(says("error_multiplicative", "Log"));
  EXPECT_EQ(reader.Attribute("resolved_scenario"), Bytes(result / "resolved.yaml"));
}

}  // namespace
}  // namespace reckon::harness
