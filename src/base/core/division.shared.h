#ifndef LUMEL_BASE_CORE_DIVISION_SHARED_H
#define LUMEL_BASE_CORE_DIVISION_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// 2⁻¹²⁶. By smaller numbers Vulkan devices may divide as they like; some find infinity. Light of a
/// lamp that went out fades away through such numbers.
LUMEL_CONST float kLeastDivisor = 1.1754944e-38f;

LUMEL_SHARED_END
#endif
