#ifndef LUMEL_METHODS_MATRIX_LAST_BOUNCE_SHARED_H
#define LUMEL_METHODS_MATRIX_LAST_BOUNCE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kLastBounceGroup = 64u;   ///< threads per workgroup of last_bounce.comp
LUMEL_CONST uint kLastBounceStates = 16u;  ///< maximum per dispatch

/// Push constants of last_bounce.comp.
struct LastBounceParams {
    uint lumels;   ///< N
    uint patches;  ///< n
    uint states;
};

LUMEL_SHARED_END
#endif
