#ifndef LUMEL_NEARFIELD_NEAR_ROWS_SHARED_H
#define LUMEL_NEARFIELD_NEAR_ROWS_SHARED_H
#include "core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kNearGroup = 64u;

/// Push constants of near_rows.comp.
struct NearParams {
    uint count;  ///< rows
};

LUMEL_SHARED_END
#endif
