#ifndef LUMEL_SOLVE_SHOOTING_FIGURES_SHARED_H
#define LUMEL_SOLVE_SHOOTING_FIGURES_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kSumGroup = 64u;  ///< group size of reduction kernels; a power of two
LUMEL_CONST uint kTermColumns = 8u;

/// Sums over all lumels.
struct Terms {
    vec4 column[kTermColumns];
};

/// Push constants of lumel_sums.total.comp.
struct TotalParams {
    uint parts;
};

LUMEL_SHARED_END
#endif
