#version 460
#include "methods/gather/gather.shared.h"
#include "solve/shooting/lumel_sums.shared.h"
#include "solve/shooting/radiosity.glsl"

// Change of the solution, and difference of its halves:
//
//     terms: Σ A 𝓛|ΔH|, Σ A 𝓛(ρ|ΔH|), Σ A 𝓛(H), 1;
//            Σ |H_0 - H_1|²/4 over channels (the mean's expected squared error), Σ H, N.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { BounceFiguresParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Sums { vec3 sums[]; };  // [2][N]
layout(scalar) readonly buffer Change { vec3 change[]; };
layout(scalar) readonly buffer Irradiance { vec3 irradiance[]; };
layout(scalar) writeonly buffer Parts { Terms parts[]; };

#include "solve/shooting/sum.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    Terms terms = no_terms();
    if (i < p.count && surface[i].a > 0.0) {
        const vec3 moved = abs(change[i]), h = irradiance[i];
        terms.column[0] = surface[i].a * vec4(luminance(moved), luminance(surface[i].rgb * moved),
                                              luminance(h), 1.0);
        if (p.taken.x > 0u && p.taken.y > 0u) {
            const vec3 d =
                0.5 * (sums[i] / float(p.taken.x) - sums[p.count + i] / float(p.taken.y));
            terms.column[1] = vec4(dot(d, d), h.r + h.g + h.b, 1.0, 0.0);
        }
    }
    const Terms sum = add_over_group(terms, 2u);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = sum;
}
