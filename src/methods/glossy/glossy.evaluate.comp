#version 460
#include "methods/glossy/glossy.shared.h"
#include "solve/shooting/radiosity.glsl"

// H as the mean over all iterations since the last restart, and the difference of its halves: the
// first three terms of iteration.evaluate.comp, and Σ A 𝓛 of absorbed light.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { GlossyEvaluateParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Sums { vec3 sums[]; };  // [2][N]
layout(scalar) readonly buffer Absorbed { vec3 absorbed[]; };  // [2][N]
layout(scalar) writeonly buffer Irradiance { vec3 irradiance[]; };
layout(scalar) writeonly buffer Parts { Terms parts[]; };

#include "solve/shooting/sum.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    Terms terms = no_terms();
    if (i < p.count) {
        const float n = p.batches[0] + p.batches[1];
        const vec3 h = n > 0.0 ? (sums[i] + sums[p.count + i]) / n : vec3(0.0);
        irradiance[i] = surface[i].w > 0.0 ? h : vec3(0.0);
        if (surface[i].w > 0.0 && min(p.batches[0], p.batches[1]) > 0.0) {
            const vec3 d =
                0.5 * (sums[i] / p.batches[0] - sums[p.count + i] / p.batches[1]);
            const vec3 taken = (absorbed[i] + absorbed[p.count + i]) / n;
            terms.column[0] = vec4(dot(d, d), h.r + h.g + h.b, 1.0,
                                   surface[i].w * luminance(taken));
        }
    }
    terms = add_over_group(terms);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = terms;
}
