// sample_recording FILE.h5: a small recording with known contents, for readers in other languages.

#include "ground_truth/recorded_run.h"

int main(int argc, char** argv) {
  using namespace reckon::ground_truth;
  if (argc != 2) return 2;
  RunRecorder recorder(argv[1], testing::SmallPlan());
  for (int k = 0; k < 1500; ++k) {
    Truth truth = testing::SomeTruth(k);
    truth.X_WB.p = {1.0 * k, 2.0 * k, 3.0 * k};
    recorder.Add(truth);
    recorder.Add(testing::ImuAt(k));
    reckon::estimator::Estimate estimate = testing::SomeEstimate(k);
    for (int i = 0; i < 15; ++i) estimate.covariance(i, i) = i + 1.0;
    recorder.Add(0, estimate);
  }
  recorder.AddPrior(0, {});
  recorder.Close();
  return 0;
}
