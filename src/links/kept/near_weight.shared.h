#ifndef LUMEL_LINKS_KEPT_NEAR_WEIGHT_SHARED_H
#define LUMEL_LINKS_KEPT_NEAR_WEIGHT_SHARED_H
#include "base/core/precise.shared.h"
LUMEL_SHARED_BEGIN

/// Weights of 1 in all channels.
LUMEL_CONST uint kNearWeightOne = 0x84020100u;

/// Weights of a near link, stored as RGB9E5: as glm::unpackF3x9_E1x5(), without a call of pow().
LUMEL_FUNCTION vec3 near_weight(uint packed)
{
    const uint mantissa = 9u, mask = (1u << mantissa) - 1u;
    const uint bias = 15u, bias_of_float = 127u, mantissa_of_float = 23u;
    const uint exponent = packed >> 3u * mantissa;
    const float scale =
        uintBitsToFloat((exponent + bias_of_float - bias - mantissa) << mantissa_of_float);
    LUMEL_PRECISE vec3 weight = scale * vec3(float(packed & mask), float(packed >> mantissa & mask),
                                             float(packed >> 2u * mantissa & mask));
    return weight;
}

LUMEL_SHARED_END
#endif
