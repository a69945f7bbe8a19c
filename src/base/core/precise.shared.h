#ifndef LUMEL_BASE_CORE_PRECISE_SHARED_H
#define LUMEL_BASE_CORE_PRECISE_SHARED_H
#include "base/core/shared.h"

// Arithmetic with the same results on CPU and GPU, bit for bit: additions and multiplications of
// floats in a fixed order. Three things break it, so code for both
//
// - declares results LUMEL_PRECISE, and its C++ is compiled with -ffp-contract=off: a fused
//   multiply-add rounds once, not twice;
// - replaces tiny values by 0: devices may flush denormal results;
// - does not divide: Vulkan allows divisions an error of 2.5 ulp.
//
// Vulkan leaves the rounding of additions and multiplications to the device; this needs the
// nearest.

// clang-format off
#ifdef __cplusplus
#define LUMEL_PRECISE
#else
#define LUMEL_PRECISE precise
#endif
// clang-format on

LUMEL_SHARED_BEGIN

#ifdef __cplusplus
using glm::floatBitsToUint;
using glm::uintBitsToFloat;
#endif

/// Smaller values count as 0. Products of three of light, weights and albedo are normal floats.
LUMEL_CONST float kTiny = 1e-25f;

LUMEL_FUNCTION float without_tiny(float x)
{
    return x < kTiny && x > -kTiny ? 0.0f : x;
}

LUMEL_FUNCTION vec3 without_tiny(vec3 x)  // NOLINT(performance-unnecessary-value-param)
{
    return vec3(without_tiny(x.x), without_tiny(x.y), without_tiny(x.z));
}

/// 1 / x for x in [kTiny, 1 / kTiny], within 1e-6 of it: an estimate from the bits, refined by
/// Newton's method.
LUMEL_FUNCTION float reciprocal(float x)
{
    const uint estimate = 0x7ef311c7u;  // within 12 %
    LUMEL_PRECISE float y = uintBitsToFloat(estimate - floatBitsToUint(x));
    for (int step = 0; step < 3; ++step) {
        LUMEL_PRECISE float product = x * y;
        LUMEL_PRECISE float correction = 2.0f - product;
        y = y * correction;
    }
    return y;
}

LUMEL_SHARED_END
#endif
