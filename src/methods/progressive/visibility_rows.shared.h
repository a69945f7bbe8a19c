#ifndef LUMEL_METHODS_PROGRESSIVE_VISIBILITY_ROWS_SHARED_H
#define LUMEL_METHODS_PROGRESSIVE_VISIBILITY_ROWS_SHARED_H
#include "solve/transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kRowsInAWord = 32u;
LUMEL_CONST uint kNoRow = 0xffffffffu;  ///< patch without a row

/// A batch of shots in a list of patches with rows.
struct RowsBatch {
    EyeViewLayout views;
    uint count;         ///< N lumels
    uint shots;         ///< K
    uint first_place;   ///< index of the batch in its list
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
    float sign_factor;  ///< -1: takes light back, 1: sends it
};

/// Push constants of visibility_rows.record.comp and visibility_rows.shoot.comp.
struct RowsParams {
    DispatchRange range;  ///< lumels of this dispatch
    RowsBatch batch;
};

LUMEL_SHARED_END
#endif
