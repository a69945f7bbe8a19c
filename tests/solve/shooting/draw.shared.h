#ifndef LUMEL_TESTS_SHOOTING_DRAW_SHARED_H
#define LUMEL_TESTS_SHOOTING_DRAW_SHARED_H
#include "solve/shooting/power_pyramid.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of draw.comp.
struct DrawParams {
    PyramidLayout pyramid;
    uint count;
};

LUMEL_SHARED_END
#endif
