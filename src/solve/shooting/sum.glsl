#ifndef LUMEL_SHOOTING_SUM_GLSL
#define LUMEL_SHOOTING_SUM_GLSL

// Sums one Terms per invocation over the workgroup.

#include "solve/shooting/lumel_sums.shared.h"

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

shared vec4 columns[kTermColumns][kSumGroup];

// Sums `mine` over the workgroup in the first `used` columns; the others are 0. All invocations
// must call this. One invocation sums each column: on a CPU device the six barriers of a tree cost
// more than they save.
Terms add_over_group(Terms mine, uint used)
{
    const uint me = gl_LocalInvocationID.x;
    for (uint c = 0u; c < used; ++c)
        columns[c][me] = mine.column[c];
    barrier();
    if (me < used) {
        vec4 sum = columns[me][0];
        for (uint k = 1u; k < kSumGroup; ++k)
            sum += columns[me][k];
        columns[me][0] = sum;
    }
    barrier();
    Terms sums = no_terms();
    for (uint c = 0u; c < used; ++c)
        sums.column[c] = columns[c][0];
    barrier();  // before the next sum
    return sums;
}

Terms add_over_group(Terms mine)
{
    return add_over_group(mine, kTermColumns);
}

#endif
