#include "reckon/ground_truth/run_recorder.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstring>
#include <thread>

#include "ground_truth/recorded_run.h"
#include "reckon/ground_truth/recording_reader.h"

namespace reckon::ground_truth {
namespace {

using testing::Bytes;
using testing::DvlAt;
using testing::EncodersAt;
using testing::ImuAt;
using testing::SmallPlan;
using testing::SomeEstimate;
using testing::SomeTruth;
using testing::TemporaryFolder;

/// Equal bit by bit: -0.0 differs from 0.0, a NaN equals itself.
template <class A, class B>
bool SameBits(const A& a, const B& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

template <class A, class B>
void ExpectSameState(const A& a, const B& b) {
  EXPECT_EQ(a.t_ns, b.t_ns);
  EXPECT_TRUE(SameBits(a.X_WB.R, b.X_WB.R));
  EXPECT_TRUE(SameBits(a.X_WB.p, b.X_WB.p));
  EXPECT_TRUE(SameBits(a.v_WB, b.v_WB));
  EXPECT_TRUE(SameBits(a.gyro_bias_rad_s, b.gyro_bias_rad_s));
  EXPECT_TRUE(SameBits(a.accel_bias_m_s2, b.accel_bias_m_s2));
}

void RecordSmallRun(const std::filesystem::path& path, int steps) {
  RunRecorder recorder(path, SmallPlan());
  for (int k = 0; k < steps; ++k) {
    const models::TimeNs t_ns = 1'000'000 * models::TimeNs{k};
    recorder.Add(SomeTruth(t_ns));
    recorder.Add(ImuAt(t_ns));
    if (k % 3 == 0) recorder.Add(EncodersAt(t_ns));
    recorder.Add(0, SomeEstimate(t_ns));
  }
  recorder.Close();
}

TEST(RunRecorder, TruthComesBackBitByBit) {
  const TemporaryFolder folder;
  RecordSmallRun(folder / "run.h5", 3000);  // more than two chunks
  const RecordingReader reader(folder / "run.h5");
  EXPECT_TRUE(reader.closed());
  auto cursor = reader.ReadTruth();
  for (int k = 0; k < 3000; ++k) {
    const auto truth = cursor.Next();
    ASSERT_TRUE(truth);
    const Truth expected = SomeTruth(1'000'000 * models::TimeNs{k});
    ExpectSameState(*truth, expected);
    EXPECT_TRUE(SameBits(truth->w_WB_B, expected.w_WB_B));
    EXPECT_TRUE(SameBits(truth->wheel_rate_rad_s, expected.wheel_rate_rad_s));
    EXPECT_TRUE(SameBits(truth->wheel_slip_m_s, expected.wheel_slip_m_s));
    EXPECT_TRUE(SameBits(truth->wheel_load_n, expected.wheel_load_n));
  }
  EXPECT_FALSE(cursor.Next());
}

TEST(RunRecorder, FeetComeBackBitByBit) {
  const TemporaryFolder folder;
  RecordingPlan plan = SmallPlan();
  plan.feet = {"left_foot", "right_foot"};
  Truth truth = SomeTruth(0);
  truth.feet.count = 2;
  truth.feet.foot[0] = {true, 31.5, 4.25, 1e-3, 0.034, {0.0, 0.6, 0.8}};
  truth.feet.foot[1].centre_m_s = 1.5;
  {
    RunRecorder recorder(folder / "run.h5", plan);
    recorder.Add(truth);
    EXPECT_THROW(recorder.Add(SomeTruth(1)), std::invalid_argument);  // without feet
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  const auto read = reader.ReadTruth().Next();
  ASSERT_TRUE(read);
  ASSERT_EQ(read->feet.count, 2);
  for (int i = 0; i < 2; ++i) {
    const FootTruth &foot = read->feet.foot[i], &expected = truth.feet.foot[i];
    EXPECT_EQ(foot.contact, expected.contact);
    EXPECT_EQ(foot.normal_n, expected.normal_n);
    EXPECT_EQ(foot.tangential_n, expected.tangential_n);
    EXPECT_EQ(foot.slip_m_s, expected.slip_m_s);
    EXPECT_EQ(foot.centre_m_s, expected.centre_m_s);
    EXPECT_TRUE(SameBits(foot.normal, expected.normal));
  }
}

TEST(RunRecorder, MeasurementsComeBackBitByBitInOrderOfArrival) {
  const TemporaryFolder folder;
  // Late encoders arrive after younger IMU samples, and two sensors arrive at one instant.
  const std::vector<models::Measurement> sent = {ImuAt(10), DvlAt(0),      ImuAt(20), ImuAt(30),
                                                 DvlAt(50), EncodersAt(5), ImuAt(40)};
  {
    RunRecorder recorder(folder / "run.h5", SmallPlan());
    for (const auto& measurement : sent) recorder.Add(measurement);
    recorder.Close();
  }
  auto cursor = RecordingReader(folder / "run.h5").ReadMeasurements();  // outlives its reader
  for (const auto& expected : sent) {
    const auto found = cursor.Next();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->sensor, expected.sensor);
    EXPECT_EQ(found->valid_ns, expected.valid_ns);
    EXPECT_EQ(found->arrival_ns, expected.arrival_ns);
    ASSERT_EQ(found->sample.index(), expected.sample.index());
    if (const auto* imu = std::get_if<models::ImuSample>(&expected.sample)) {
      const auto& other = std::get<models::ImuSample>(found->sample);
      EXPECT_TRUE(SameBits(other.gyro_rad_s, imu->gyro_rad_s));
      EXPECT_TRUE(SameBits(other.accel_m_s2, imu->accel_m_s2));
      EXPECT_EQ(other.interval_ns, imu->interval_ns);
      EXPECT_FALSE(other.gyro_saturated);
      EXPECT_TRUE(other.accel_saturated);
    } else if (const auto* encoders = std::get_if<models::EncoderSample>(&expected.sample)) {
      const auto& other = std::get<models::EncoderSample>(found->sample);
      EXPECT_TRUE(SameBits(other.angle_rad, encoders->angle_rad));
      EXPECT_TRUE(SameBits(other.rate_rad_s, encoders->rate_rad_s));
      EXPECT_EQ(other.interval_ns, encoders->interval_ns);
    } else {
      const auto& other = std::get<models::BodyVelocitySample>(found->sample);
      const auto& dvl = std::get<models::BodyVelocitySample>(expected.sample);
      EXPECT_TRUE(SameBits(other.v_WS_S, dvl.v_WS_S));
      EXPECT_TRUE(SameBits(other.covariance, dvl.covariance));
    }
  }
  EXPECT_FALSE(cursor.Next());
}

TEST(RunRecorder, EstimatesComeBackWithTheirCovariance) {
  const TemporaryFolder folder;
  estimator::Estimate plain = SomeEstimate(5);
  plain.has_covariance = false;
  plain.has_biases = false;
  {
    RunRecorder recorder(folder / "run.h5", SmallPlan());
    recorder.Add(0, SomeEstimate(1));
    recorder.Add(0, plain);  // has none: its neighbours keep theirs
    recorder.Add(0, SomeEstimate(9));
    recorder.Add(1, plain);
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  EXPECT_EQ(reader.estimators(), (std::vector<std::string>{"riekf", "odometry"}));
  auto cursor = reader.ReadEstimates(0);
  const auto first = cursor.Next(), second = cursor.Next(), third = cursor.Next();
  ASSERT_TRUE(first && second && third);
  ExpectSameState(*first, SomeEstimate(1));
  EXPECT_EQ(first->form, estimator::ErrorForm::kMultiplicative);
  EXPECT_TRUE(first->has_covariance && first->has_biases);
  EXPECT_TRUE(SameBits(first->covariance, SomeEstimate(1).covariance));
  EXPECT_FALSE(second->has_covariance || second->has_biases);
  EXPECT_TRUE(SameBits(third->covariance, SomeEstimate(9).covariance));
  EXPECT_FALSE(cursor.Next());
  EXPECT_TRUE(reader.ReadEstimates(1).Next());
}

TEST(RunRecorder, PriorCorrectionsAndRefusalsComeBack) {
  const TemporaryFolder folder;
  estimator::Prior prior;
  prior.t_ns = 3;
  prior.w_WB_B = {0.1, 0.2, 0.3};
  prior.covariance = SomeEstimate(1).covariance;
  estimator::Correction correction;
  correction.t_ns = 8;
  correction.sensor = 1;
  correction.decision = estimator::Decision::kInflated;
  correction.rows = 3;
  correction.innovation = {1.0, 2.0, 3.0};
  correction.covariance << 4, 1, 2, 1, 5, 3, 2, 3, 6;
  correction.nis = 7.5;
  estimator::Report applied, refused, unused;
  applied.Add(correction);
  refused.refusal = estimator::Refusal::kLate;
  unused.refusal = estimator::Refusal::kUnused;
  {
    RunRecorder recorder(folder / "run.h5", SmallPlan());
    recorder.AddPrior(0, prior);
    recorder.Add(EncodersAt(8));
    recorder.Add(0, EncodersAt(8), applied);
    recorder.Add(0, DvlAt(2), refused);
    recorder.Add(0, DvlAt(4), unused);  // by design, not an event
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  const auto read_prior = reader.ReadPrior(0);
  ASSERT_TRUE(read_prior);
  EXPECT_EQ(read_prior->t_ns, 3);
  EXPECT_EQ(read_prior->w_WB_B, prior.w_WB_B);
  EXPECT_EQ(read_prior->covariance, prior.covariance);
  EXPECT_FALSE(reader.ReadPrior(1));  // never started

  auto corrections = reader.ReadCorrections(0);
  const auto read = corrections.Next();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->t_ns, 8);
  EXPECT_EQ(read->sensor, 1);
  EXPECT_EQ(read->decision, estimator::Decision::kInflated);
  EXPECT_EQ(read->rows, 3);
  EXPECT_EQ(read->innovation, correction.innovation);
  EXPECT_EQ(read->covariance, correction.covariance);
  EXPECT_EQ(read->nis, 7.5);
  EXPECT_FALSE(corrections.Next());

  auto refusals = reader.ReadRefusals(0);
  const auto late = refusals.Next();
  ASSERT_TRUE(late);
  EXPECT_EQ(late->sensor, 2);
  EXPECT_EQ(late->valid_ns, 2);
  EXPECT_EQ(late->reason, estimator::Refusal::kLate);
  EXPECT_FALSE(refusals.Next());
}

TEST(RunRecorder, SensorsAndAttributesComeBack) {
  const TemporaryFolder folder;
  RunRecorder(folder / "run.h5", SmallPlan()).Close();
  const RecordingReader reader(folder / "run.h5");
  EXPECT_EQ(reader.Attribute("resolved_scenario"), "schema: 1\nname: ünïcode\n");
  EXPECT_FALSE(reader.Attribute("absent"));
  ASSERT_EQ(reader.sensors().size(), 3U);
  const models::MountedSensor expected = SmallPlan().sensors[0].sensor, found = reader.sensors()[0];
  EXPECT_EQ(found.name, "imu");
  EXPECT_EQ(found.period_ns, expected.period_ns);
  EXPECT_EQ(found.X_BS.R, expected.X_BS.R);
  EXPECT_EQ(found.X_BS.p, expected.X_BS.p);
  EXPECT_EQ(reader.sensors()[1].kind, models::SensorKind::kEncoders);
  EXPECT_EQ(reader.sensors()[2].kind, models::SensorKind::kBodyVelocity);
}

TEST(RunRecorder, ThePlanChoosesStreamsAndRates) {
  const TemporaryFolder folder;
  RecordingPlan plan = SmallPlan();
  plan.measurements = plan.covariance = plan.corrections = false;
  plan.truth_period_ns = 10;
  plan.estimate_period_ns = 50;
  {
    RunRecorder recorder(folder / "run.h5", plan);
    for (int t_ns = 0; t_ns < 100; ++t_ns) {
      recorder.Add(SomeTruth(t_ns));
      recorder.Add(ImuAt(t_ns));
      recorder.Add(0, SomeEstimate(t_ns));
      recorder.Add(0, ImuAt(t_ns), estimator::Report());
    }
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  auto truth = reader.ReadTruth();
  for (int k = 0; k < 10; ++k) EXPECT_EQ(truth.Next().value().t_ns, 10 * k);
  EXPECT_FALSE(truth.Next());
  auto estimates = reader.ReadEstimates(0);
  EXPECT_EQ(estimates.Next().value().t_ns, 0);
  const auto last = estimates.Next();
  EXPECT_EQ(last.value().t_ns, 50);
  EXPECT_FALSE(last->has_covariance);  // not recorded
  EXPECT_FALSE(estimates.Next());
  EXPECT_FALSE(reader.ReadMeasurements().Next());
  EXPECT_FALSE(reader.ReadCorrections(0).Next());
}

/// Stamps of a 200 Hz sensor within one second, each off its grid by `offset_ns`, thinned to 60 Hz.
std::vector<models::TimeNs> ThinnedStamps(models::TimeNs offset_ns) {
  const TemporaryFolder folder;
  RecordingPlan plan = SmallPlan();
  plan.truth_period_ns = plan.estimate_period_ns = 16'666'667;
  {
    RunRecorder recorder(folder / "run.h5", plan);
    for (models::TimeNs t_ns = offset_ns; t_ns <= 1'000'000'000; t_ns += 5'000'000) {
      recorder.Add(SomeTruth(t_ns));
      recorder.Add(0, SomeEstimate(t_ns));
      if (t_ns > 500'000'000) recorder.Add(1, SomeEstimate(t_ns));  // has a clock of its own
    }
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  std::vector<models::TimeNs> stamps, truth;
  for (auto rows = reader.ReadEstimates(0); const auto row = rows.Next();) {
    stamps.push_back(row->t_ns);
  }
  for (auto rows = reader.ReadTruth(); const auto row = rows.Next();) truth.push_back(row->t_ns);
  EXPECT_EQ(truth, stamps);
  EXPECT_GT(reader.ReadEstimates(1).Next().value().t_ns, 500'000'000);
  return stamps;
}

TEST(RunRecorder, ThinsToARateThatIsNoFractionOfTheRows) {
  for (const models::TimeNs offset_ns : {0, 1, 1'234'567}) {
    std::vector<models::TimeNs> expected;  // the first row at or after each 1/60 s
    for (models::TimeNs due_ns = 0; due_ns <= 995'000'000; due_ns += 16'666'667) {
      const models::TimeNs rows = (due_ns - offset_ns + 4'999'999) / 5'000'000;
      expected.push_back(offset_ns + 5'000'000 * rows);
    }
    EXPECT_EQ(expected.size(), 60U);
    EXPECT_EQ(ThinnedStamps(offset_ns), expected) << offset_ns;
  }
}

TEST(RunRecorder, TheSameRowsGiveTheSameBytes) {
  const TemporaryFolder folder;
  RecordSmallRun(folder / "a.h5", 1500);
  // Again beside a busy thread: nothing of the process may leak into the file.
  std::thread other([&folder] { RecordSmallRun(folder / "other.h5", 700); });
  RecordSmallRun(folder / "b.h5", 1500);
  other.join();
  RecordSmallRun(folder / "c.h5", 1499);
  EXPECT_EQ(Bytes(folder / "a.h5"), Bytes(folder / "b.h5"));
  EXPECT_NE(Bytes(folder / "a.h5"), Bytes(folder / "c.h5"));
}

TEST(RunRecorder, TakesFlatMemory) {
  const TemporaryFolder folder;
  RunRecorder recorder(folder / "run.h5", SmallPlan());
  const auto record = [&recorder](int from, int to) {
    for (int k = from; k < to; ++k) {
      recorder.Add(SomeTruth(k));
      recorder.Add(0, SomeEstimate(k));
    }
  };
  record(0, 5000);
  const auto before = mallinfo2().uordblks;
  record(5000, 25000);
  const auto grown = static_cast<double>(mallinfo2().uordblks) - static_cast<double>(before);
  // 28 MB were recorded meanwhile; the chunk index in HDF5's metadata cache may grow a little.
  EXPECT_LT(grown, 0.3e6);
  recorder.Close();
}

TEST(RunRecorder, RefusesRowsThatAreNotAsPlanned) {
  const TemporaryFolder folder;
  RunRecorder recorder(folder / "run.h5", SmallPlan());
  models::Measurement measurement = EncodersAt(0);
  std::get<models::EncoderSample>(measurement.sample).angle_rad.resize(3);
  EXPECT_THROW(recorder.Add(measurement), std::invalid_argument);
  measurement = EncodersAt(0);
  measurement.sensor = 0;
  EXPECT_THROW(recorder.Add(measurement), std::invalid_argument);
  Truth truth = SomeTruth(0);
  truth.wheel_load_n.resize(1);
  EXPECT_THROW(recorder.Add(truth), std::invalid_argument);
}

TEST(RunRecorder, NamesThePathThatCantBeWritten) {
  try {
    RunRecorder recorder("/nowhere/at/all/run.h5", SmallPlan());
    FAIL() << "made a file in a folder that does not exist";
  } catch (const RecordingError& error) {
    EXPECT_EQ(std::string(error.what()),
              "/nowhere/at/all/run.h5: can't make the recording: No such file or directory");
  }
}

TEST(RecordingReader, RefusesWhatIsNoRecording) {
  const TemporaryFolder folder;
  EXPECT_THROW(RecordingReader(folder / "absent.h5"), RecordingError);
  std::ofstream(folder / "text.h5") << "not HDF5";
  EXPECT_THROW(RecordingReader(folder / "text.h5"), RecordingError);
}

}  // namespace
}  // namespace reckon::ground_truth
