#include <gtest/gtest.h>

#include "ground_truth/recorded_run.h"
#include "reckon/ground_truth/recording_reader.h"

namespace reckon::ground_truth {
namespace {

using testing::DvlAt;
using testing::SmallPlan;
using testing::SomeEstimate;
using testing::TemporaryFolder;

/// What reading says of a recording with this correction, estimate and refusal in its second row.
std::string Complaint(const estimator::Correction& correction,
                      const estimator::Estimate& estimate = SomeEstimate(2),
                      estimator::Refusal refusal = estimator::Refusal::kLate) {
  const TemporaryFolder folder;
  {
    RunRecorder recorder(folder / "run.h5", SmallPlan());
    estimator::Correction whole;
    whole.rows = 3;
    estimator::Report first, second;
    first.Add(whole);
    second.Add(correction);
    first.refusal = estimator::Refusal::kLate;
    second.refusal = refusal;
    for (const auto& report : {first, second}) {
      recorder.Add(DvlAt(2));
      recorder.Add(0, DvlAt(2), report);
    }
    recorder.Add(0, SomeEstimate(1));
    recorder.Add(0, estimate);
    recorder.Close();
  }
  const RecordingReader reader(folder / "run.h5");
  try {
    for (auto rows = reader.ReadCorrections(0); rows.Next();) continue;
    for (auto rows = reader.ReadEstimates(0); rows.Next();) continue;
    for (auto rows = reader.ReadRefusals(0); rows.Next();) continue;
  } catch (const RecordingError& error) {
    return error.what() + (folder / "run.h5").string().size() + 2;  // what follows the file's name
  }
  return "";
}

TEST(RecordingReader, RefusesNumbersThatStandForNothing) {
  estimator::Correction whole;
  whole.rows = 3;
  EXPECT_EQ(Complaint(whole), "");
  const std::string corrections = "estimates/riekf/corrections, row 1: damaged: ";
  estimator::Correction damaged = whole;
  damaged.rows = 4;
  EXPECT_EQ(Complaint(damaged), corrections + "rows is 4, expected 1 to 3");
  damaged.rows = 0;
  EXPECT_EQ(Complaint(damaged), corrections + "rows is 0, expected 1 to 3");
  damaged = whole;
  damaged.decision = static_cast<estimator::Decision>(6);
  EXPECT_EQ(Complaint(damaged), corrections + "decision is 6, expected 0 to 5");
  damaged = whole;
  damaged.reason = static_cast<estimator::Refusal>(12);
  EXPECT_EQ(Complaint(damaged), corrections + "reason is 12, expected 0 to 11");
  damaged = whole;
  damaged.sensor = 3;
  EXPECT_EQ(Complaint(damaged), corrections + "sensor is 3, expected 0 to 2");
  estimator::Estimate estimate = SomeEstimate(2);
  estimate.form = static_cast<estimator::ErrorForm>(255);
  EXPECT_EQ(Complaint(whole, estimate),
            "estimates/riekf/state, row 1: damaged: error_form is 255, expected 0 to 2");
  EXPECT_EQ(Complaint(whole, SomeEstimate(2), static_cast<estimator::Refusal>(77)),
            "estimates/riekf/refusals, row 1: damaged: reason is 77, expected 0 to 11");
}

}  // namespace
}  // namespace reckon::ground_truth
