// error: reckon/estimator/estimator.h: No such file
#include "reckon/estimator/estimate.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/estimator/estimator.h"
#endif
