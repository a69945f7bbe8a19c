#ifndef LUMEL_METHODS_REDISTRIBUTION_INCREMENTAL_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_INCREMENTAL_SHARED_H
#include "atlas/near/moved_box.shared.h"
#include "methods/progressive/visibility_rows.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of incremental.receive.comp. batch.sign_factor: -1 takes light of patches without
/// rows back, 1 sends all.
struct RedistributeParams {
    DispatchRange range;  ///< lumels of this dispatch
    RowsBatch batch;
    uint boxes;   ///< boxes of moved instances, before and after
    float slack;  ///< angle [rad] by which they can seem larger in views
    uint keeps;   ///< 1: stores the current visibility in rows
};

LUMEL_SHARED_END
#endif
