#ifndef LUMEL_NEARFIELD_NEAR_FACTOR_GLSL
#define LUMEL_NEARFIELD_NEAR_FACTOR_GLSL

// Form factors of the near field. Declares its rows.

#include "base/core/shared.h"

layout(scalar) readonly buffer NearFirst { uint near_first[]; };  // [N + 1]
layout(scalar) readonly buffer NearColumn { uint near_column[]; };
layout(scalar) readonly buffer NearFactor { float near_factors[]; };

// F_ij of a near pair, 0 if absent: the columns of a row ascend.
float near_factor(uint i, uint j)
{
    uint low = near_first[i], high = near_first[i + 1u];
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (near_column[middle] < j)
            low = middle + 1u;
        else
            high = middle;
    }
    return low < near_first[i + 1u] && near_column[low] == j ? near_factors[low] : 0.0;
}

#endif
