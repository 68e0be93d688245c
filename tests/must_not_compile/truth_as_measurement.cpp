// error: (convert|conversion|no matching function)
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"

reckon::models::Measurement Leak(const reckon::ground_truth::Truth& truth) {
#ifdef MUST_NOT_COMPILE
  return truth;
#else
  return {.valid_ns = truth.t_ns};
#endif
}
