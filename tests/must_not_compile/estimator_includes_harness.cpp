// error: reckon/harness/scenario.h: No such file
#include "reckon/estimator/estimator.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/harness/scenario.h"
#endif
