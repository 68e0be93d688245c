#pragma once

/// After the parameters of a function or lambda: inlined wherever it is called. A loop over slots
/// is only as fast as its body, which has to be compiled anew for each slot's constant.
#define RECKON_INLINED __attribute__((always_inline))
