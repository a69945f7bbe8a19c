#ifndef LUMEL_METHODS_REDISTRIBUTION_PAPER_INCREMENTAL_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_PAPER_INCREMENTAL_SHARED_H
#include "methods/progressive/visibility_rows.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of paper_incremental.receive.comp.
struct MergedParams {
    DispatchRange range;  ///< lumels of this dispatch
    RowsBatch batch;
    uint takes_back;  ///< 1: patches without rows take their shot light back from the old position
};

LUMEL_SHARED_END
#endif
