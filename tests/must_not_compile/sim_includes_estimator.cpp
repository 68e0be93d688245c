// error: reckon/estimator/estimator.h: No such file
#include "reckon/sim/world.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/estimator/estimator.h"
#endif
