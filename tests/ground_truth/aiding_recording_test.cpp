// Depth, poses and contacts through a recording and back.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "ground_truth/recorded_run.h"
#include "reckon/ground_truth/metrics.h"
#include "reckon/ground_truth/record_codec.h"
#include "reckon/ground_truth/recording_reader.h"

namespace reckon::ground_truth {
namespace {

using models::SensorKind;
using testing::SomeRotation;
using testing::TemporaryFolder;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Bit by bit: -0.0 differs from 0.0, a NaN equals itself.
template <class A>
bool SameBits(const A& a, const A& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

RecordingPlan Plan(const std::vector<std::string>& feet = {"left", "right"}) {
  RecordingPlan plan;
  plan.sensors = {{{"depth", SensorKind::kDepth, {}, 100'000'000}, {}},
                  {{"gps", SensorKind::kPose, {}, 200'000'000}, {}},
                  {{"feet", SensorKind::kContacts, {}, 2'000'000}, feet}};
  plan.estimators = {"riekf"};
  return plan;
}

models::Measurement PoseAt(models::TimeNs t_ns, bool has_orientation) {
  models::PoseSample pose;
  pose.X_WS = {SomeRotation(0.3), {1.0 / 3.0, -0.0, kNan}};
  pose.position_sigma_m = {0.1, 0.2, 0.3};
  pose.orientation_sigma_rad = {1e-300, 4.0, kNan};
  pose.has_orientation = has_orientation;
  return {1, t_ns, t_ns + 7, pose};
}

models::Measurement ContactsAt(models::TimeNs t_ns, int feet = 2) {
  models::ContactSample contacts;
  contacts.probability = models::FootVector::LinSpaced(feet, 0.1, 0.9);
  return {2, t_ns, t_ns + 1, contacts};
}

TEST(AidingRecording, SamplesComeBackBitByBit) {
  const TemporaryFolder folder;
  const std::vector<models::Measurement> sent = {{0, 1, 2, models::DepthSample{1.0 / 3.0}},
                                                 PoseAt(3, true),
                                                 ContactsAt(4),
                                                 PoseAt(5, false),
                                                 {0, 6, 7, models::DepthSample{kNan}}};
  {
    RunRecorder recorder(folder / "run.h5", Plan());
    for (const auto& measurement : sent) recorder.Add(measurement);
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  ASSERT_EQ(reader.sensors().size(), 3U);
  EXPECT_EQ(reader.sensors()[0].kind, SensorKind::kDepth);
  EXPECT_EQ(reader.sensors()[1].kind, SensorKind::kPose);
  EXPECT_EQ(reader.sensors()[2].kind, SensorKind::kContacts);
  auto cursor = reader.ReadMeasurements();
  for (const auto& expected : sent) {
    const auto found = cursor.Next();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->sensor, expected.sensor);
    EXPECT_EQ(found->valid_ns, expected.valid_ns);
    EXPECT_EQ(found->arrival_ns, expected.arrival_ns);
    ASSERT_EQ(found->sample.index(), expected.sample.index());
    if (const auto* depth = std::get_if<models::DepthSample>(&expected.sample)) {
      const auto& other = std::get<models::DepthSample>(found->sample);
      EXPECT_EQ(std::memcmp(&other.depth_m, &depth->depth_m, sizeof(double)), 0);
    } else if (const auto* pose = std::get_if<models::PoseSample>(&expected.sample)) {
      const auto& other = std::get<models::PoseSample>(found->sample);
      EXPECT_TRUE(SameBits(other.X_WS.R, pose->X_WS.R));
      EXPECT_TRUE(SameBits(other.X_WS.p, pose->X_WS.p));
      EXPECT_TRUE(SameBits(other.position_sigma_m, pose->position_sigma_m));
      EXPECT_TRUE(SameBits(other.orientation_sigma_rad, pose->orientation_sigma_rad));
      EXPECT_EQ(other.has_orientation, pose->has_orientation);
    } else {
      EXPECT_TRUE(SameBits(std::get<models::ContactSample>(found->sample).probability,
                           std::get<models::ContactSample>(expected.sample).probability));
    }
  }
  EXPECT_FALSE(cursor.Next());
}

TEST(AidingRecording, RefusesAnotherNumberOfFeetThanPlanned) {
  const TemporaryFolder folder;
  RunRecorder recorder(folder / "run.h5", Plan());
  EXPECT_THROW(recorder.Add(ContactsAt(1, 3)), std::invalid_argument);
  EXPECT_NO_THROW(recorder.Add(ContactsAt(1, 2)));
}

TEST(AidingRecording, RefusesMoreFeetThanASampleHolds) {
  const TemporaryFolder folder;
  RunRecorder(folder / "four.h5", Plan({"a", "b", "c", "d"})).Close();
  EXPECT_EQ(RecordingReader(folder / "four.h5").sensors().size(), 3U);
  RunRecorder(folder / "five.h5", Plan({"a", "b", "c", "d", "e"})).Close();
  try {
    RecordingReader(folder / "five.h5");
    FAIL() << "was read";
  } catch (const RecordingError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        (folder / "five.h5").string() + ": sensor feet has 5 channels, at most 4 are possible");
  }
}

TEST(AidingRecording, RefusesAFlagThatIsNone) {
  // Order, two stamps, nine and three times three numbers; then the flag.
  std::vector<std::byte> row(3 * 8 + 18 * 8 + 1);
  std::uint64_t order = 0;
  const auto decode = [&](std::uint8_t flag) {
    row.back() = static_cast<std::byte>(flag);
    RowDecoder decoder(row.data());
    return std::get<models::PoseSample>(
               DecodeMeasurement(decoder, 1, SensorKind::kPose, 0, &order).sample)
        .has_orientation;
  };
  EXPECT_FALSE(decode(0));
  EXPECT_TRUE(decode(1));
  EXPECT_THROW(decode(2), RecordingError);
}

TEST(AidingRecording, DuplicatesAreCountedAndUselessSamplesAreNot) {
  const Metrics metrics = MetricCatalogue({"gps"}, {});
  EXPECT_TRUE(metrics.Find("refused_gps_duplicate_count"));
  EXPECT_TRUE(metrics.Find("refused_gps_invalid_count"));
  EXPECT_FALSE(metrics.Find("refused_gps_unused_count"));
  EXPECT_FALSE(metrics.Find("refused_gps_none_count"));
}

TEST(AidingRecording, ARefusedDuplicateComesBack) {
  const TemporaryFolder folder;
  estimator::Report report;
  report.refusal = estimator::Refusal::kDuplicate;
  {
    RunRecorder recorder(folder / "run.h5", Plan());
    recorder.Add(PoseAt(3, true));
    recorder.Add(0, PoseAt(3, true), report);
    recorder.Close();
  }
  auto refusals = RecordingReader(folder / "run.h5").ReadRefusals(0);
  const auto refused = refusals.Next();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, estimator::Refusal::kDuplicate);
}

}  // namespace
}  // namespace reckon::ground_truth
