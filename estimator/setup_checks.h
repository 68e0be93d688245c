#pragma once

#include "reckon/estimator/setup.h"

namespace reckon::estimator {

/// Throws std::invalid_argument, which names the entry, for beliefs that no filter can work with:
/// noise that is negative or not finite, gravity that is not positive, a static initialisation of
/// no duration, and what CheckDrive refuses.
void CheckSetup(const Setup& setup);

/// Throws std::invalid_argument for a drive without wheels on both sides, with a wheel that is not
/// an entry of any sample, a radius that is not positive, or encoders that the suite hasn't got.
void CheckDrive(const models::Suite& suite);

/// Throws std::invalid_argument for a prior with a number that is not finite, a rotation that is
/// none, or a covariance that is not symmetric with a non-negative diagonal.
void CheckPrior(const Prior& prior);

}  // namespace reckon::estimator
