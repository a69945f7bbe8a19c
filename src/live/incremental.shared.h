#ifndef LUMEL_LIVE_INCREMENTAL_SHARED_H
#define LUMEL_LIVE_INCREMENTAL_SHARED_H
#include "transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

/// Where something was before it moved, or is now.
struct MovedBox {
    vec3 low;  ///< corners [m], world
    vec3 high;
};

/// Push constants of incremental.receive.comp.
struct RedistributeParams {
    EyeViewLayout views;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint count;         ///< N lumels
    uint shots;         ///< K
    uint first_place;   ///< of the batch in its list
    float near_radius;  ///< pairs closer than this × the larger size belong to the near field
    uint boxes;         ///< of what moved, before and after
    float slack;        ///< angle [rad] by which views may show them larger
    float sign_factor;  ///< -1: takes light of patches without rows back, 1: sends all anew
    uint keeps;         ///< 1: rows are to hold what is seen now
};

/// Push constants of incremental.reset.comp.
struct ResetParams {
    uint count;  ///< lumels
};

LUMEL_SHARED_END
#endif
