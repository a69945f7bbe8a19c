#ifndef LUMEL_METHODS_REDISTRIBUTION_INCREMENTAL_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_INCREMENTAL_SHARED_H
#include "atlas/near/moved_box.shared.h"
#include "solve/transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of incremental.receive.comp.
struct RedistributeParams {
    EyeViewLayout views;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint count;         ///< N lumels
    uint shots;         ///< K
    uint first_place;   ///< index of the batch in its list
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
    uint boxes;         ///< boxes of moved instances, before and after
    float slack;        ///< angle [rad] by which they can seem larger in views
    float sign_factor;  ///< -1: takes light of patches without rows back, 1: sends all
    uint keeps;         ///< 1: stores the current visibility in rows
};

/// Push constants of incremental.reset.comp.
struct ResetParams {
    uint count;  ///< lumels
};

LUMEL_SHARED_END
#endif
