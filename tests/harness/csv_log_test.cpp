#include "reckon/harness/csv_log.h"

#include <gtest/gtest.h>

#include "ground_truth/recorded_run.h"
#include "harness/log_case.h"

namespace reckon::harness {
namespace {

using ground_truth::testing::TemporaryFolder;
using models::Measurement;
using testing::WriteFile;
using testing::WriteStandingLog;

constexpr models::TimeNs kMs = 1'000'000;

std::vector<Measurement> All(const LoadedLog& log) {
  CsvLog csv(log, SuiteOf(log));
  std::vector<Measurement> all;
  while (const auto m = csv.Next()) all.push_back(*m);
  return all;
}

std::string Complaint(const std::filesystem::path& folder) {
  try {
    const LoadedLog log = LoadLog(folder);
    CsvLog csv(log, SuiteOf(log));
    (void)csv.Start({}, 1);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find(": error: ") + 9);
  }
  return "";
}

TEST(CsvLog, GivesMeasurementsByArrivalFromTheFirstTruthOn) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "log");
  const LoadedLog log = LoadLog(folder / "log");
  CsvLog csv(log, SuiteOf(log));
  const estimator::Prior prior = csv.Start({.sample_error = false, .sigma = {}}, 1);
  EXPECT_EQ(prior.t_ns, 0) << "time counts from the whole second of the first row";
  EXPECT_EQ(prior.X_WB.p, Eigen::Vector3d(1, 2, -5));
  EXPECT_EQ(prior.gyro_bias_rad_s, Eigen::Vector3d::Zero()) << "unknown: about none";
  const auto all = All(log);
  ASSERT_EQ(all.size(), 10u + 6u) << "the IMU sample that ends with the start is before it";
  models::TimeNs last = 0;
  for (const Measurement& m : all) {
    EXPECT_GE(m.arrival_ns, last);
    last = m.arrival_ns;
    const bool depth = std::holds_alternative<models::DepthSample>(m.sample);
    EXPECT_EQ(m.arrival_ns - m.valid_ns, depth ? 20 * kMs : 0);
  }
  EXPECT_EQ(all[0].valid_ns, 10 * kMs);
  EXPECT_EQ(std::get<models::ImuSample>(all[0].sample).interval_ns, 10 * kMs);
  EXPECT_EQ(std::get<models::ImuSample>(all[0].sample).accel_m_s2.z(), 9.81);
  EXPECT_EQ(last, 120 * kMs);
}

TEST(CsvLog, TruthWithoutBiasesSaysSo) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "log");
  const LoadedLog log = LoadLog(folder / "log");
  CsvLog csv(log, SuiteOf(log));
  const auto truth = csv.NextTruth();
  ASSERT_TRUE(truth);
  EXPECT_FALSE(truth->has_biases);
  EXPECT_EQ(truth->X_WB.p, Eigen::Vector3d(1, 2, -5));
  int rows = 1;
  while (csv.NextTruth()) ++rows;
  EXPECT_EQ(rows, 11);
}

TEST(CsvLog, ReadsEveryKindOfSensor) {
  const TemporaryFolder folder;
  WriteStandingLog(folder / "log", R"(
left_wheels: [left]
right_wheels: [right]
)");
  WriteFile(folder / "log" / "log.yaml", R"(
sensors:
  imu: {type: imu, file: imu.csv, rate_hz: 100, quaternion_wxyz: [0, 0, 0, 1]}
  a_dvl: {type: body_velocity, file: dvl.csv, rate_hz: 10, noise_m_per_s: [0.1, 0.2, 0.3],
          rotation_matrix: [0, -0.999, 0.01, 1, 0, 0, 0, 0.01, 1]}
  b_pose: {type: pose, file: pose.csv, rate_hz: 10, noise_position_m: [1, 1, 2],
           noise_orientation_rad: [0.1, 0.1, 0.2]}
  c_wheels: {type: encoders, file: wheels.csv, rate_hz: 10, channels: [left, right]}
  d_feet: {type: contacts, file: feet.csv, rate_hz: 10, channels: [lf, rf]}
left_wheels: [left]
right_wheels: [right]
nominal: {wheels: {encoders: c_wheels, rolling_radius_m: 0.1, effective_track_m: 0.5}}
start: {position_m: [4, 5, 6], velocity_m_s: [1, 0, 0]}
)");
  WriteFile(folder / "log" / "dvl.csv",
            "t_s,arrival_s,v_x_m_s,v_y_m_s,v_z_m_s\n100.05,100.06,1,2,3\n100.07,100.08,,2,3\n");
  WriteFile(folder / "log" / "pose.csv",
            "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n100.05,7,8,9,0,0,0,1\n");
  WriteFile(folder / "log" / "wheels.csv", "t_s,right_rad,left_rad\n100.0,1,10\n100.1,1.5,10.2\n");
  WriteFile(folder / "log" / "feet.csv", "t_s,rf,lf\n100.05,0.25,1\n");
  const LoadedLog log = LoadLog(folder / "log");
  const models::Suite suite = SuiteOf(log);
  ASSERT_TRUE(suite.wheels);
  EXPECT_EQ(suite.wheels->left, std::vector<int>{0});
  EXPECT_TRUE(suite.sensors[0].X_BS.R.isUnitary(1e-12)) << "rounded matrices are made rotations";
  CsvLog csv(log, suite);
  EXPECT_EQ(csv.Start({}, 1).X_WB.p, Eigen::Vector3d(4, 5, 6)) << "as told, no error is drawn";
  std::map<std::string, std::vector<Measurement>> by_name;
  while (const auto m = csv.Next()) by_name[suite.sensors[m->sensor].name].push_back(*m);
  const auto& dvl = std::get<models::BodyVelocitySample>(by_name["a_dvl"][0].sample);
  EXPECT_EQ(dvl.v_WS_S, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(dvl.covariance(2, 2), 0.09, 1e-15);
  EXPECT_EQ(by_name["a_dvl"][0].arrival_ns - by_name["a_dvl"][0].valid_ns, 10 * kMs);
  EXPECT_TRUE(
      std::isnan(std::get<models::BodyVelocitySample>(by_name["a_dvl"][1].sample).v_WS_S.x()));
  const auto& pose = std::get<models::PoseSample>(by_name["b_pose"][0].sample);
  EXPECT_TRUE(pose.has_orientation);
  EXPECT_NEAR(pose.X_WS.R(0, 0), -1.0, 1e-15);
  EXPECT_EQ(pose.position_sigma_m.z(), 2.0);
  const auto& wheels = std::get<models::EncoderSample>(by_name["c_wheels"][1].sample);
  EXPECT_NEAR(wheels.rate_rad_s[0], 2.0, 1e-12) << "left: 0.2 rad in 0.1 s, by difference";
  EXPECT_NEAR(wheels.rate_rad_s[1], 5.0, 1e-12);
  const auto& feet = std::get<models::ContactSample>(by_name["d_feet"][0].sample);
  EXPECT_EQ(feet.probability, Eigen::Vector2d(1, 0.25)) << "in the order of the channels";
}

TEST(CsvLog, SaysWhatIsWrongInItsDescription) {
  const TemporaryFolder folder;
  const auto log = folder / "log";
  WriteStandingLog(log);
  EXPECT_EQ(Complaint(log), "");
  const auto with = [&](const std::string& text) {
    WriteFile(log / "log.yaml", text);
    return Complaint(log);
  };
  EXPECT_EQ(with("sensors: {}\n"), "'/sensors': expected at least one sensor");
  EXPECT_EQ(with("sensors: {imu: {type: imu, file: imo.csv, rate_hz: 100}}\n"),
            "'/sensors/imu/file': there is no file '" + (log / "imo.csv").string() + "'");
  const std::string imu = "sensors: {imu: {type: imu, file: imu.csv, rate_hz: 100";
  EXPECT_EQ(with(imu + "}}\n"),
            "expected a 'start' section or a 'truth' with rows: where does it begin?");
  EXPECT_EQ(with(imu + ", rotation_matrix: [1, 0, 0, 0, 1, 0, 0, 0, 0.9]}}\n"),
            "'/sensors/imu/rotation_matrix': expected the nine numbers of a rotation, row by row");
  EXPECT_EQ(with(imu + ", quaternion_wxyz: [1, 1, 0, 0]}}\n"),
            "'/sensors/imu/quaternion_wxyz': expected a quaternion of length one");
  EXPECT_EQ(with(imu + "}}\nnominal: {wheels: {encoders: imu}}\n"),
            "'/nominal/wheels/encoders': expected a sensor of type encoders");
  EXPECT_EQ(with("sensors: {d: {type: depth, file: depth.csv, rate_hz: 50}}\n"),
            "the log has no IMU sample");
  EXPECT_THROW(LoadLog(folder / "nowhere"), LogMissing);
}

}  // namespace
}  // namespace reckon::harness
