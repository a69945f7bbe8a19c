#ifndef LUMEL_RASTER_NEAR_NEAR_ROWS_SHARED_H
#define LUMEL_RASTER_NEAR_NEAR_ROWS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kNearGroup = 64u;

/// Push constants of near_rows.comp.
struct NearParams {
    uint count;  ///< number of rows
};

LUMEL_SHARED_END
#endif
