// error: reckon/sim/world_config.h: No such file
#include "reckon/estimator/estimator.h"
#ifdef MUST_NOT_COMPILE
#include "reckon/sim/world_config.h"
#endif
