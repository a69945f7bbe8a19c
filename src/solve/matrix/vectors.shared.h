#ifndef LUMEL_SOLVE_MATRIX_VECTORS_SHARED_H
#define LUMEL_SOLVE_MATRIX_VECTORS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kVectorGroup = 64u;
LUMEL_CONST uint kScatterLanes = 8u;  ///< invocations that share a row's exact part

/// Push constants of vectors.gather.comp.
struct PatchGatherParams {
    uint count;   ///< n
    uint width;   ///< floats of a plane, ≥ n
    uint states;  ///< vectors of colours
};

/// Push constants of vectors.scatter.comp.
struct ScatterParams {
    uint count;  ///< n
    uint width;  ///< floats of a plane
    uint states;
    uint per_row;  ///< entries of the exact part
};

LUMEL_SHARED_END
#endif
