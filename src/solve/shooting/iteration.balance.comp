#version 460
#include "solve/shooting/iteration.shared.h"
#include "solve/shooting/iteration.balance.glsl"

// Sums of the energy balance, column by column as iteration.glsl reads them.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { AverageParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Direct { vec3 direct[]; };
layout(scalar) readonly buffer Indirect { vec3 indirect[]; };
layout(scalar) readonly buffer NearEmission { vec3 near_emission[]; };
layout(scalar) readonly buffer NearSource { vec3 near_source[]; };
layout(scalar) readonly buffer Source { vec3 source[]; };
layout(scalar) readonly buffer Earlier { vec3 earlier[]; };  // [2][N] U
layout(scalar) writeonly buffer Parts { Terms parts[]; };

#include "solve/shooting/sum.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    Terms terms = no_terms();
    if (i < p.count) {
        const vec3 reflecting = surface[i].rgb * surface[i].w;
        for (uint h = 0u; h < 2u; ++h) {
            const uint at = h * p.count + i;
            const vec3 from_emission = mean(direct[at], p.averages.emission_shots[h]);
            const vec3 from_source = mean(indirect[at], p.averages.source_shots[h]);
            terms.column[kDirectColumn + h].rgb = reflecting * (from_emission + near_emission[i]);
            terms.column[kPhaseColumn + h].rgb = reflecting * from_source;
            terms.column[kEarlierColumn + h].rgb = reflecting * earlier[at];
        }
        terms.column[kSourceColumn].rgb = source[i] * surface[i].w;
        terms.column[kNearColumn].rgb = reflecting * near_source[i];
    }
    terms = add_over_group(terms);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = terms;
}
