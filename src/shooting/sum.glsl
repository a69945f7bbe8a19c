#ifndef LUMEL_SHOOTING_SUM_GLSL
#define LUMEL_SHOOTING_SUM_GLSL

// Adds up one Terms per invocation over the workgroup.

#include "shooting/figures.shared.h"

Terms no_terms()
{
    Terms terms;
    for (uint c = 0u; c < kTermColumns; ++c)
        terms.column[c] = vec4(0.0);
    return terms;
}

Terms plus(Terms a, Terms b)
{
    for (uint c = 0u; c < kTermColumns; ++c)
        a.column[c] += b.column[c];
    return a;
}

#define SUMMAND Terms
#include "shooting/group_sum.glsl"

#endif
