// error: (no match for .operator=|no viable overloaded .=)
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"

reckon::models::Measurement Leak(const reckon::ground_truth::Truth& truth) {
  reckon::models::Measurement measurement;
  measurement.valid_ns = truth.t_ns;
#ifdef MUST_NOT_COMPILE
  measurement.sample = truth;
#endif
  return measurement;
}
