#ifndef LUMEL_TESTS_GPU_TWICE_SHARED_H
#define LUMEL_TESTS_GPU_TWICE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of twice.comp.
struct TwiceParams {
    uint first, last;  ///< values [first, last)
    uint added;
};

LUMEL_SHARED_END
#endif
