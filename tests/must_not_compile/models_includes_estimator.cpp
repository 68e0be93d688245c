// error: reckon/estimator/estimate.h: No such file
#include "reckon/models/measurement.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/estimator/estimate.h"
#endif
