#ifndef LUMEL_SOLVE_TRANSPORT_FORM_FACTORS_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_FORM_FACTORS_SHARED_H
#include "solve/transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of form_factors.look.comp.
struct BlockParams {
    uint first;  ///< first block
    uint count;  ///< K
};

/// Push constants of form_factors.receive.comp.
struct FormFactorParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint lumels;          ///< N
    uint shots;           ///< K
    uint first_block;     ///< the shots are those of blocks [first_block, first_block + K)
    float near_radius;    ///< pairs closer than this × the larger size are in the near field
};

LUMEL_SHARED_END
#endif
