// error: use of deleted function
#include "reckon/estimator/estimator.h"

int Applied(reckon::estimator::Estimator& estimator, const reckon::models::Measurement& m) {
  int applied = 0;
  const reckon::estimator::Report report = estimator.Process(m);
  for (const auto& correction : report.corrections()) applied += correction.rows;
#ifdef MUST_NOT_COMPILE
  for (const auto& correction : estimator.Process(m).corrections()) applied += correction.rows;
#endif
  return applied;
}
