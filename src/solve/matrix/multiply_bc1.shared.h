#ifndef LUMEL_SOLVE_MATRIX_MULTIPLY_BC1_SHARED_H
#define LUMEL_SOLVE_MATRIX_MULTIPLY_BC1_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kBc1Lanes = 64u;  ///< invocations that share the columns of a group's rows
LUMEL_CONST uint kBc1Rows = 8u;    ///< rows of a group, which share each value of x

/// Push constants of multiply_bc1.comp.
struct Bc1Params {
    uint width;        ///< width of a plane of x and of y, filled up to whole blocks
    uint first_state;  ///< first of the kStates states
    vec3 log_factor;   ///< log2 of each channel's largest entry − offset
    float log_step;    ///< log2 from one code to the next
};

LUMEL_SHARED_END
#endif
