// error: (convert|conversion|no matching function)
#include "reckon/estimator/estimator.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"

void Leak(reckon::estimator::Estimator& estimator, const reckon::ground_truth::Truth& truth) {
  estimator.Process(reckon::models::Measurement{.valid_ns = truth.t_ns});
#ifdef MUST_NOT_COMPILE
  estimator.Process(truth);
#endif
}
