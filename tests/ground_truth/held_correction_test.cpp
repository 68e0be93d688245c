// Which measurement a recorded correction names, when filters hold measurements back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "ground_truth/recorded_run.h"
#include "reckon/estimator/registry.h"
#include "reckon/ground_truth/hdf5_handle.h"
#include "reckon/ground_truth/newest_orders.h"

namespace reckon::ground_truth {
namespace {

using testing::SmallPlan;
using testing::TemporaryFolder;

constexpr models::TimeNs kMs = 1'000'000;
constexpr models::SensorId kImu = 0, kVelocity = 2;

struct CorrectionRow {
  std::int64_t t_ns;
  std::uint64_t measurement;
};
struct MeasurementRow {
  std::int64_t valid_ns;
  std::uint64_t order;
};

/// Two columns of a table, as any reader of HDF5 finds them.
template <class Row>
std::vector<Row> ReadColumns(const std::filesystem::path& path, const std::string& table,
                             const char* first, const char* second) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle dataset(H5Dopen2(file.get(), table.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  std::vector<Row> rows(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  const Hdf5Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Row)), H5Tclose);
  H5Tinsert(type.get(), first, 0, H5T_NATIVE_INT64);
  H5Tinsert(type.get(), second, sizeof(std::int64_t), H5T_NATIVE_UINT64);
  EXPECT_GE(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), 0);
  return rows;
}

/// A robot that stands for a second, by the time of arrival: an IMU at 200 Hz, velocity at 50 Hz.
std::vector<models::Measurement> Standing(models::TimeNs imu_latency_ns,
                                          models::TimeNs velocity_latency_ns) {
  std::vector<models::Measurement> sent;
  for (models::TimeNs t_ns = 5 * kMs; t_ns <= 1000 * kMs; t_ns += 5 * kMs) {
    sent.push_back({kImu, t_ns, t_ns + imu_latency_ns,
                    models::ImuSample{{0, 0, 0}, {0, 0, 9.81}, 5 * kMs, false, false}});
    if (t_ns % (20 * kMs) != 0) continue;
    models::BodyVelocitySample velocity;
    velocity.covariance = 0.01 * Eigen::Matrix3d::Identity();
    // Between two IMU samples, so that no stamp is the filter's own by chance.
    const models::TimeNs valid_ns = t_ns - 2 * kMs;
    sent.push_back({kVelocity, valid_ns, valid_ns + velocity_latency_ns, velocity});
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const auto& a, const auto& b) { return a.arrival_ns < b.arrival_ns; });
  return sent;
}

/// Runs a filter over `sent`, recording as the harness does.
void Record(const std::filesystem::path& path, const std::vector<models::Measurement>& sent) {
  RecordingPlan plan = SmallPlan();
  estimator::Setup setup;
  for (RecordedSensor& sensor : plan.sensors) {
    sensor.sensor.X_BS = {};
    setup.suite.sensors.push_back(sensor.sensor);
  }
  setup.gravity_m_s2 = 9.81;
  const auto filter = estimator::FindEstimator("inekf")->make(setup);
  estimator::Prior prior;
  prior.covariance = 0.01 * estimator::ErrorCovariance::Identity();
  filter->Start(prior);
  RunRecorder recorder(path, plan);
  for (const models::Measurement& measurement : sent) {
    recorder.Add(measurement);
    recorder.Add(0, measurement, filter->Process(measurement));
  }
  recorder.Close();
}

/// Every correction must name a velocity, and be of that measurement's valid stamp.
void ExpectNamed(models::TimeNs imu_latency_ns, models::TimeNs velocity_latency_ns) {
  const TemporaryFolder folder;
  Record(folder / "run.h5", Standing(imu_latency_ns, velocity_latency_ns));
  std::map<std::uint64_t, std::int64_t> valid_ns;
  for (const auto& row :
       ReadColumns<MeasurementRow>(folder / "run.h5", "measurements/dvl", "valid_ns", "order")) {
    valid_ns[row.order] = row.valid_ns;
  }
  const auto corrections = ReadColumns<CorrectionRow>(
      folder / "run.h5", "estimates/riekf/corrections", "t_ns", "measurement");
  EXPECT_GE(corrections.size(), 48U);  // 50 in a second; the last may still wait for the IMU
  for (const CorrectionRow& row : corrections) {
    ASSERT_TRUE(valid_ns.contains(row.measurement)) << row.measurement;
    EXPECT_EQ(row.t_ns, valid_ns.at(row.measurement));
  }
}

TEST(HeldCorrection, NamesTheMeasurementThatWaitedForALateImu) { ExpectNamed(20 * kMs, 0); }

TEST(HeldCorrection, NamesTheMeasurementThatCameLate) { ExpectNamed(0, 12 * kMs); }

TEST(NewestOrders, FindsTheNewestOfEachSensorAndForgetsTheOldest) {
  NewestOrders orders(2);
  EXPECT_EQ(orders.Find(0, 0), NewestOrders::kUnknown);  // an empty place is no measurement
  EXPECT_EQ(orders.Find(7, 0), NewestOrders::kUnknown);  // nor is another sensor
  orders.Add(0, 10, 100);
  orders.Add(1, 10, 101);
  orders.Add(0, 10, 102);  // sent twice
  EXPECT_EQ(orders.Find(0, 10), 102U);
  EXPECT_EQ(orders.Find(1, 10), 101U);
  for (std::size_t i = 0; i < NewestOrders::kKept; ++i) {
    orders.Add(0, 20 + static_cast<models::TimeNs>(i), 200 + i);
  }
  EXPECT_EQ(orders.Find(0, 10), NewestOrders::kUnknown);
  EXPECT_EQ(orders.Find(0, 20), 200U);
  EXPECT_EQ(orders.Find(1, 10), 101U);
}

}  // namespace
}  // namespace reckon::ground_truth
