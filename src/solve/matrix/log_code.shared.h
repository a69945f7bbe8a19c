#ifndef LUMEL_SOLVE_MATRIX_LOG_CODE_SHARED_H
#define LUMEL_SOLVE_MATRIX_LOG_CODE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST float kLogCodes = 255.0f;  ///< the code of a channel's largest entry
LUMEL_CONST float kMinLogCode = 0.5f;  ///< below, an entry is 0; blocks make fractions

LUMEL_SHARED_END
#endif
