#version 460
#include "solve/figures.shared.h"

// Adds the workgroups' parts up to one.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { TotalParams p; };
layout(binding = 0, scalar) readonly buffer Parts { Terms parts[]; };
layout(binding = 1, scalar) writeonly buffer Totals { Terms totals[]; };

#include "solve/sum.glsl"

void main()
{
    Terms terms;
    for (uint c = 0u; c < kTermColumns; ++c)
        terms.column[c] = vec4(0.0);
    for (uint part = gl_LocalInvocationID.x; part < p.parts; part += kSumGroup)
        for (uint c = 0u; c < kTermColumns; ++c)
            terms.column[c] += parts[part].column[c];
    terms = add_over_group(terms);
    if (gl_LocalInvocationID.x == 0u)
        totals[0] = terms;
}
