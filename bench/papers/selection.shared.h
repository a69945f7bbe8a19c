#ifndef LUMEL_BENCH_SELECTION_SHARED_H
#define LUMEL_BENCH_SELECTION_SHARED_H
#include "solve/shooting/power_pyramid.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of selection.draw.comp.
struct DrawParams {
    PyramidLayout pyramid;
    float u;    ///< 0…1
    uint draw;  ///< which of them this is
};

LUMEL_SHARED_END
#endif
