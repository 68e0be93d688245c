// error: reckon/ground_truth/metrics.h: No such file
#include "reckon/ground_truth/truth.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/ground_truth/metrics.h"
#endif
