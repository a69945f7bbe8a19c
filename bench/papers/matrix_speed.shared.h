#ifndef LUMEL_BENCH_MATRIX_SPEED_SHARED_H
#define LUMEL_BENCH_MATRIX_SPEED_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kRowLanes = 64u;

/// Push constants of matrix_speed.row.comp.
struct RowParams {
    uint quads;       ///< columns / 4
    uint first_row;   ///< of this part; channels lie below one another
    uint plane_rows;  ///< of a channel
};

/// Push constants of matrix_speed.reflect.comp.
struct ReflectParams {
    uint count;  ///< n
    uint width;  ///< of a plane
};

LUMEL_SHARED_END
#endif
