// error: reckon/ground_truth/run_recorder.h: No such file
#include "reckon/estimator/estimator.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/ground_truth/run_recorder.h"
#endif
