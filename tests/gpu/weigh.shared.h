#ifndef LUMEL_TESTS_GPU_WEIGH_SHARED_H
#define LUMEL_TESTS_GPU_WEIGH_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kWeighGroup = 32u;

/// A struct that both compilers must lay out alike: its members have three sizes.
struct Colored {
    vec3 color;
    uint place;
    vec2 unused;
};

/// Push constants of weigh.comp.
struct WeighParams {
    uint count;
};

LUMEL_SHARED_END
#endif
