#version 460
#include "solve/shooting/lumel_sums.shared.h"

// Sums the parts of all workgroups.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { TotalParams p; };
layout(scalar) readonly buffer Parts { Terms parts[]; };
layout(scalar) writeonly buffer Totals { Terms totals[]; };

#include "solve/shooting/sum.glsl"

void main()
{
    Terms terms = no_terms();
    for (uint part = gl_LocalInvocationID.x; part < p.parts; part += kSumGroup)
        terms = plus(terms, parts[part]);
    terms = add_over_group(terms);
    if (gl_LocalInvocationID.x == 0u)
        totals[0] = terms;
}
