#ifndef LUMEL_BENCH_MATRIX_ROWS_SHARED_H
#define LUMEL_BENCH_MATRIX_ROWS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kProductLanes = 64u;  ///< invocations that share the columns of a group's rows
LUMEL_CONST uint kTeam = 8u;           ///< of them read neighbouring columns: 128 bytes of floats
/// Rows of a group: what is read of the vectors serves all of them, and as many loads of a lane are
/// under way at once.
LUMEL_CONST uint kProductRows = 8u;

/// Push constants of matrix_rows.*.comp.
struct ProductParams {
    uint quads;         ///< columns / 4
    uint first_row;     ///< of this part of the matrix; planes lie below one another
    uint plane_rows;    ///< of a plane, a multiple of kProductRows
    uint first_vector;  ///< of the vectors in use
    uint vector_step;   ///< from one vector in use to the next
    uint plane_step;    ///< from the vector of a plane to that of the next
    uint in_quads;      ///< width of a vector read / 4
    uint out_width;     ///< of a vector written
    uint count;         ///< rows written of a plane
    vec3 factor;        ///< float16: of each plane
    vec3 log_factor;    ///< log2 of each plane's largest entry − offset
    float log_step;     ///< of log2 from one code to the next
};

LUMEL_SHARED_END
#endif
