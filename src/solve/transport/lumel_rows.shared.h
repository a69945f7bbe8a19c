#ifndef LUMEL_SOLVE_TRANSPORT_LUMEL_ROWS_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_LUMEL_ROWS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Form factors times this keep all digits of a half float from 4e-9 on.
LUMEL_CONST float kRowScale = 16384.0f;

/// The form factor of a lumel and a patch.
struct RowEntry {
    uint code;  ///< the patch in the upper 16 bits, the factor × kRowScale below, a half float
};

LUMEL_SHARED_END
#endif
