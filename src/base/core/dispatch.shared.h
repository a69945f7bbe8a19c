#ifndef LUMEL_BASE_CORE_DISPATCH_SHARED_H
#define LUMEL_BASE_CORE_DISPATCH_SHARED_H
#include "base/core/shared.h"

// Declarations for compute kernels with one thread per element.

LUMEL_SHARED_BEGIN

LUMEL_CONST uint kGroup = 64u;  ///< threads per workgroup

/// Push constants of kernels that need nothing else.
struct CountParams {
    uint count;  ///< number of elements
};

/// Elements [first, last) of one dispatch, see gpu::Pacer::dispatch_parts().
struct DispatchRange {
    uint first;
    uint last;
};

LUMEL_SHARED_END

#endif
