#ifndef LUMEL_LIVE_LIVE_SHARED_H
#define LUMEL_LIVE_LIVE_SHARED_H
#include "core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kShowGroup = 64u;

/// Push constants of live.show.comp.
struct ShowParams {
    uint count;  ///< lumels
};

LUMEL_SHARED_END
#endif
