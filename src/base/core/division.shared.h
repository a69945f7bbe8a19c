#ifndef LUMEL_BASE_CORE_DIVISION_SHARED_H
#define LUMEL_BASE_CORE_DIVISION_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// 2⁻¹²⁶. Vulkan does not define the result of a division by less, and some devices return
/// infinity. After a lamp is switched off, the light left becomes that small.
LUMEL_CONST float kMinDivisor = 1.1754944e-38f;

LUMEL_SHARED_END
#endif
