#ifndef LUMEL_TESTS_GPU_WEIGH_GLSL
#define LUMEL_TESTS_GPU_WEIGH_GLSL

// Declares `weights`, and `nothing`, which no one reads.

#include "base/core/shared.h"

layout(scalar) readonly buffer Nothing { float nothing[]; };
layout(scalar) readonly buffer Weights { float weights[]; };

float weight_of(uint i)
{
    return weights[i];
}

float nothing_of(uint i)
{
    return nothing[i];
}

#endif
