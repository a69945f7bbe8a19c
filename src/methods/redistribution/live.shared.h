#ifndef LUMEL_METHODS_REDISTRIBUTION_LIVE_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_LIVE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kShowGroup = 64u;

/// Push constants of live.show.comp.
struct ShowParams {
    uint count;  ///< lumels
};

LUMEL_SHARED_END
#endif
